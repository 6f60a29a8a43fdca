#pragma once

#include "load_table.hpp"
#include "moving_points_mpi.hpp"

#include <mpi.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace comparisons {

/// Gives each point that has left the box of its owner to the first of the boxes that holds it.
void follow(std::vector<int>& owners, const std::vector<mpm::Box>& boxes, mpm::Positions at);

/// Where points were at some times, and how they load parts made at any of them.
///
/// Rank r of R keeps the points with id R / N = r in their order, whoever owns them. All functions
/// are collective over `comm`.
class PointTracks {
  public:
    using Columns = std::array<std::vector<double>, 3>;

    explicit PointTracks(MPI_Comm comm);

    /// One time more. No point is ever lost or added.
    void add(const MovingPoints& points);

    /// The same of the points that this rank keeps, without the third axis in 2-D.
    void add(Columns columns);

    /// Of the points that this rank keeps.
    mpm::Positions positions(int time) const;
    std::int64_t num_points() const { return num_points_; }
    int num_times() const { return static_cast<int>(snapshots_.size()); }

    /// Loads of the parts that `make` returns a balancer for at each of the first `num_made` times.
    ///
    /// A point stays in its part until it has left the box, as in the mini app. Parts made later
    /// load nobody. Throws what the balancers throw.
    template <typename Make>
    std::shared_ptr<const LoadTable> loads(Make&& make, int num_made) const {
        const auto table = std::make_shared<LoadTable>(num_times(), num_ranks_);
        for (int made = 0; made < num_made; ++made) count(*table, made, make());
        return table;
    }

  private:
    void count_points(std::size_t mine);
    void count(LoadTable& table, int made, const mpm::Balancer& balancer) const;

    MPI_Comm comm_;
    int rank_ = 0;
    int num_ranks_ = 1;
    std::int64_t num_points_ = 0;
    std::vector<Columns> snapshots_;
};

}  // namespace comparisons
