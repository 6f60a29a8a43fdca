#include "migration_replay_mpi.hpp"

#include <rrcb/plan.hpp>
#include <rrcb/quality.hpp>
#include <rrcb/transfer.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace comparisons {

namespace {

/// The points that this rank keeps of the tracks, and the ranks that own them.
class Owners {
  public:
    Owners(const PointTracks& tracks, MPI_Comm comm) : tracks_(tracks), comm_(comm) {
        MPI_Comm_rank(comm, &rank_);
        MPI_Comm_size(comm, &num_ranks_);
        owners_.assign(tracks.positions(0).size(), rank_);
    }

    /// Points of this rank that have left the boxes that were made last.
    std::int64_t move_to(int time, Between between) {
        std::vector<int> inside = owners_;
        follow(inside, boxes_, tracks_.positions(time));
        const std::int64_t crossed = num_changed_since(inside);
        if (between == Between::follow) owners_ = std::move(inside);
        return crossed;
    }

    /// Calls the balancer with the points on their owners; points that change owner. Collective.
    std::int64_t rebalance(const mpm::Balancer& balancer, int time) {
        const std::vector<int> before = owners_;
        std::vector<std::int64_t> numbers(owners_.size());
        std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
        const mpm::Positions at = tracks_.positions(time);
        const rrcb::Plan there = rrcb::plan(owners_, num_ranks_, comm_);
        const auto [x, y, z, numbers_there] = rrcb::transfer(
            there, rrcb::columns(at.x, at.y, rrcb::column(at.z, at.z.empty() ? 0 : 1), numbers),
            comm_);
        take(balancer({x, y, z}, comm_), {x, y, z}, numbers_there, there);
        return num_changed_since(before);
    }

    /// Collective.
    double imbalance() const {
        std::vector<std::int64_t> loads(static_cast<std::size_t>(num_ranks_));
        for (const int owner : owners_) ++loads[static_cast<std::size_t>(owner)];
        MPI_Allreduce(MPI_IN_PLACE, loads.data(), num_ranks_, MPI_INT64_T, MPI_SUM, comm_);
        return rrcb::imbalance(std::vector<double>(loads.begin(), loads.end()));
    }

  private:
    /// Brings what the owners of points decide back to where the tracks are.
    void take(const mpm::Decomposition& made, mpm::Positions at,
              const std::vector<std::int64_t>& numbers, const rrcb::Plan& there) {
        std::vector<int> decided = made.local_owners;
        if (decided.empty()) {
            decided.resize(at.size());
            made.owners(at, decided);
        }
        std::vector<rrcb::Part> homes(decided.size() - there.import_ranks.size(), rank_);
        homes.insert(homes.end(), there.import_ranks.begin(), there.import_ranks.end());
        const rrcb::Plan back = rrcb::plan(homes, num_ranks_, comm_);
        const auto [my_numbers, mine] =
            rrcb::transfer(back, rrcb::columns(numbers, decided), comm_);
        for (std::size_t i = 0; i < mine.size(); ++i)
            owners_[static_cast<std::size_t>(my_numbers[i])] = mine[i];
        boxes_ = made.boxes;
    }

    std::int64_t num_changed_since(const std::vector<int>& before) const {
        std::int64_t changed = 0;
        for (std::size_t i = 0; i < owners_.size(); ++i) changed += owners_[i] != before[i];
        return changed;
    }

    const PointTracks& tracks_;
    MPI_Comm comm_;
    int rank_ = 0;
    int num_ranks_ = 1;
    std::vector<int> owners_;
    std::vector<mpm::Box> boxes_;
};

}  // namespace

Migration replay_migration(const PointTracks& tracks, const mpm::Balancer& balancer,
                           Between between, MPI_Comm comm) {
    Migration result;
    result.points = tracks.num_points();
    result.calls = tracks.num_times() - 1;
    Owners owners(tracks, comm);
    owners.rebalance(balancer, 0);
    std::array<std::int64_t, 2> counts{};
    double sum = 0;
    for (int time = 1; time < tracks.num_times(); ++time) {
        counts[0] += owners.move_to(time, between);
        counts[1] += owners.rebalance(balancer, time);
        const double imbalance = owners.imbalance();
        result.worst_imbalance = std::max(result.worst_imbalance, imbalance);
        sum += imbalance;
    }
    if (result.calls > 0) result.mean_imbalance = sum / result.calls;
    MPI_Allreduce(MPI_IN_PLACE, counts.data(), 2, MPI_INT64_T, MPI_SUM, comm);
    result.crossed = counts[0];
    result.moved = counts[1];
    return result;
}

}  // namespace comparisons
