#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/rank_counts_mpi.hpp"
#include "cuts/ball_search.hpp"
#include "lists/delivery_mpi.hpp"
#include "lists/remap_mpi.hpp"
#include "options/rejection.hpp"
#include "options/request.hpp"
#include "options/validation.hpp"

#include <rrcb/ghosts.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace rrcb {

namespace {

void check_ranges(std::span<const RankRange> ranks_of_parts, int num_parts, int num_ranks) {
    require(ranks_of_parts.size() == static_cast<std::size_t>(num_parts),
            "ranks_of_parts must have one entry for each part");
    for (const RankRange& ranks : ranks_of_parts)
        require(ranks.first_rank >= 0 && ranks.count >= 1 && ranks.first_rank < num_ranks &&
                    ranks.count <= num_ranks - ranks.first_rank,
                "ranks_of_parts must name ranks of this communicator");
}

/// Which of this rank's points which other ranks need.
class Neighbourhood {
  public:
    Neighbourhood(const Cuts& cuts, double radius, std::span<const RankRange> ranks_of_parts,
                  int rank, int num_ranks)
        : ranks_of_parts_(ranks_of_parts),
          rank_(rank),
          is_foreign_(foreign_parts()),
          search_(cuts, radius, is_foreign_),
          last_point_(static_cast<std::size_t>(num_ranks), no_point),
          num_sent_(static_cast<std::size_t>(num_ranks), 0) {
        if (std::ranges::count(is_foreign_, 0) == 1)
            home_ = box_of(
                cuts, static_cast<Part>(std::ranges::find(is_foreign_, 0) - is_foreign_.begin()));
    }

    /// Notes the ranks that need a point. Points come in ascending order.
    void add(LocalIndex point, const Vector& position) {
        if (home_ && search_.is_inside(position, *home_)) return;
        search_.for_each_part(position, [&](Part part) {
            const RankRange& ranks = ranks_of_parts_[static_cast<std::size_t>(part)];
            for (int rank = ranks.first_rank; rank < ranks.first_rank + ranks.count; ++rank)
                if (rank != rank_) send(point, rank);
        });
    }

    void write(GhostPlan& plan) const {
        std::vector<LocalIndex> next(num_sent_.size());
        std::exclusive_scan(num_sent_.begin(), num_sent_.end(), next.begin(), LocalIndex{0});
        plan.send_indices.resize(sent_.size());
        for (const Sent& sent : sent_)
            plan.send_indices[next[static_cast<std::size_t>(sent.rank)]++] = sent.point;
        for (std::size_t rank = 0; rank < num_sent_.size(); ++rank)
            if (num_sent_[rank] > 0) plan.send.push_back({static_cast<int>(rank), num_sent_[rank]});
    }

  private:
    struct Sent {
        LocalIndex point;
        int rank;
    };
    static constexpr LocalIndex no_point = std::numeric_limits<LocalIndex>::max();

    /// 1 for parts that another rank holds, also beside this one.
    std::vector<char> foreign_parts() const {
        std::vector<char> is_foreign;
        for (const RankRange& ranks : ranks_of_parts_)
            is_foreign.push_back(ranks.first_rank != rank_ || ranks.count > 1 ? 1 : 0);
        return is_foreign;
    }

    void send(LocalIndex point, int rank) {
        LocalIndex& last = last_point_[static_cast<std::size_t>(rank)];
        if (last == point) return;
        last = point;
        sent_.push_back({point, rank});
        ++num_sent_[static_cast<std::size_t>(rank)];
    }

    std::span<const RankRange> ranks_of_parts_;
    int rank_;
    std::vector<char> is_foreign_;
    BallSearch search_;
    std::optional<Box> home_;             ///< region of the only part that is this rank's alone
    std::vector<LocalIndex> last_point_;  ///< that was sent, by rank
    std::vector<LocalIndex> num_sent_;    ///< by rank
    std::vector<Sent> sent_;
};

/// The part of a plan that this rank knows. Not collective.
void list_sent(const Cuts& cuts, const Points& points, double radius,
               std::span<const RankRange> ranks_of_parts, MPI_Comm comm, GhostPlan& plan) {
    const int num_ranks = mpi::size_of(comm);
    require(std::isfinite(radius) && radius >= 0, "the radius must be finite, 0 or more");
    check_points(points);
    check_cuts(cuts, points.dimension);
    check_ranges(ranks_of_parts, cuts.num_parts, num_ranks);
    Neighbourhood neighbourhood(cuts, radius, ranks_of_parts, mpi::rank_of(comm), num_ranks);
    for (LocalIndex i = 0; i < points.count; ++i) neighbourhood.add(i, points.position(i));
    plan.num_points = points.count;
    neighbourhood.write(plan);
}

/// Collective; what went wrong on a rank before is told to all.
GhostPlan ghosts(const Cuts& cuts, const Points& points, double radius,
                 std::span<const RankRange> ranks_of_parts, Participant& self) {
    GhostPlan plan;
    std::uint64_t bits_of_cuts = 0;
    self.attempt([&] {
        list_sent(cuts, points, radius, ranks_of_parts, self.comm, plan);
        bits_of_cuts = bits_of(cuts);
    });
    plan.receive = exchange_counts(plan.send, self);
    agree(self, {{"the tree of cuts", bits_of_cuts},
                 {"the radius", std::bit_cast<std::uint64_t>(radius + 0.0)},
                 {"ranks_of_parts", hash_of(ranks_of_parts)}});
    return plan;
}

}  // namespace

GhostPlan ghosts(const Cuts& cuts, const Points& points, double radius,
                 std::span<const RankRange> ranks_of_parts, MPI_Comm user) {
    Participant self{mpi::duplicate_of(user)};
    return ghosts(cuts, points, radius, ranks_of_parts, self);
}

GhostPlan ghosts(const Cuts& cuts, const Points& points, double radius, MPI_Comm user) {
    Participant self{mpi::duplicate_of(user)};
    std::vector<RankRange> ranks_of_parts;
    self.attempt([&] {
        for (Part part = 0; part < cuts.num_parts; ++part)
            ranks_of_parts.push_back(ranks_of_part(part, cuts.num_parts, mpi::size_of(self.comm)));
    });
    return ghosts(cuts, points, radius, ranks_of_parts, self);
}

void detail::move(const GhostPlan& plan, std::span<const ByteColumn> columns,
                  const TransferLimits& limits, TransferReport* report, MPI_Comm user) {
    Participant self{mpi::duplicate_of(user)};
    Delivery delivery{.num_points = plan.num_points, .sent = plan.send_indices};
    self.attempt([&] {
        const int num_ranks = mpi::size_of(self.comm);
        check_counts(plan.send, plan.send_indices.size(), num_ranks);
        LocalIndex num_received = 0;
        for (const RankCount& share : plan.receive) num_received += share.count;
        check_counts(plan.receive, num_received, num_ranks);
        require(std::ranges::all_of(plan.send_indices,
                                    [&](LocalIndex i) { return i < plan.num_points; }),
                "send_indices of the plan must be below num_points");
        delivery.to = plan.send;
        delivery.from = plan.receive;
    });
    deliver(delivery, columns, limits, report, self);
}

}  // namespace rrcb
