#pragma once

#include "cell_list.hpp"
#include "workload_mpi.hpp"

#include <rrcb/plan.hpp>

#include <mpi.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace comparisons {

/// Ghosts of one partition: copies of points that parts need from others.
///
/// A point counts once for each other part that has a point within the radius of it.
struct Ghosts {
    double radius = 0;
    std::int64_t sum = 0;                       ///< over all parts
    std::int64_t most = 0;                      ///< that a part needs
    int most_neighbours = 0;                    ///< parts that a part needs ghosts from
    std::optional<std::int64_t> off_machine{};  ///< of the sum, between machines
};

/// Counts the ghosts of any partitions of the same points. Points that are not finite have none.
///
/// Points are dealt over the ranks in slabs; each slab gets the points next to it too. All
/// functions are collective over `comm`.
class GhostCounter {
  public:
    GhostCounter(const Workload& workload, const GhostRule& rule, MPI_Comm comm);

    /// parts: one of 0 ... num_parts - 1 for each point of the workload on this rank.
    Ghosts count(const std::vector<rrcb::Part>& parts, int num_parts) const;

  private:
    MPI_Comm comm_;
    GhostRule rule_;
    double radius_;
    std::vector<std::size_t> sources_;  ///< local points that are sent, some more than once
    rrcb::Plan plan_;
    std::optional<CellList> cells_;
};

}  // namespace comparisons
