#pragma once

#include "workload_mpi.hpp"

#include <rrcb/plan.hpp>

#include <mpi.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace comparisons {

/// Cut-off and machines that ghosts are counted by.
struct GhostRule {
    std::optional<double> radius{};       ///< above 0; without it twice the median spacing
    std::optional<int> ranks_per_node{};  ///< machines hold so many consecutive parts
};

/// Ghosts of one partition: copies of points that parts need from others.
///
/// A point counts once for each other part that has a point within the radius of it.
struct Ghosts {
    double radius = 0;
    std::int64_t sum = 0;                       ///< over all parts
    std::int64_t most = 0;                      ///< that a part needs
    int most_neighbours = 0;                    ///< parts that a part needs ghosts from
    std::optional<std::int64_t> off_machine{};  ///< of the sum, between machines
    std::vector<std::int64_t> of_parts{};       ///< that each part needs
};

struct PointInCube {
    std::int64_t cube;  ///< ordered by its layer, then along the other axes
    rrcb::Vector position;
    std::size_t number;  ///< in the order of arrival
};

/// Counts the ghosts of any partitions of the same points. Points that are not finite have none.
///
/// Space is divided into cubes a little wider than the radius, at most 2^20 along an axis. Layers
/// of cubes are dealt over the ranks; each rank gets the points of the layers next to its own too.
/// All functions are collective over `comm`.
class GhostCounter {
  public:
    GhostCounter(const Workload& workload, const GhostRule& rule, MPI_Comm comm);

    double radius() const { return radius_; }

    /// parts: one of 0 ... num_parts - 1 for each point of the workload on this rank.
    Ghosts count(const std::vector<rrcb::Part>& parts, int num_parts) const;

  private:
    MPI_Comm comm_;
    GhostRule rule_;
    double radius_;
    std::int64_t num_layers_;
    std::vector<std::size_t> sources_;  ///< local points that are sent, some more than once
    rrcb::Plan plan_;
    std::vector<PointInCube> points_;  ///< of this rank's layers and those next to them
};

}  // namespace comparisons
