#pragma once

#include "workload_mpi.hpp"

#include <rrcb/plan.hpp>

#include <mpi.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace comparisons {

/// The radius and the machines with which ghosts are counted.
struct GhostRule {
    std::optional<double> radius{};       ///< above 0; default: twice the median spacing
    std::optional<int> ranks_per_node{};  ///< number of consecutive parts on a machine
};

/// The ghosts of one partition: copies of points that parts need from other parts.
///
/// A point counts once for each other part that has a point within the radius.
struct Ghosts {
    double radius = 0;
    std::int64_t sum = 0;     ///< ghosts of all parts
    std::int64_t most = 0;    ///< largest number of ghosts of a part
    int most_neighbours = 0;  ///< largest number of parts from which a part needs ghosts
    std::optional<std::int64_t> off_machine{};  ///< ghosts from another machine
    std::vector<std::int64_t> of_parts{};       ///< ghosts of each part
};

struct PointInCube {
    std::int64_t cube;  ///< number of the cube: by layer first, then along the other axes
    rrcb::Vector position;
    std::size_t number;  ///< position in the order of arrival
};

/// Counts the ghosts of several partitions of the same points. Points that are not finite have
/// none.
///
/// Space is divided into cubes a little wider than the radius, at most 2^20 along an axis. The
/// layers of cubes are distributed over the ranks. Each rank also gets the points of the layers
/// next to its own. All functions are collective over `comm`.
class GhostCounter {
  public:
    GhostCounter(const Workload& workload, const GhostRule& rule, MPI_Comm comm);

    double radius() const { return radius_; }

    /// Counts the ghosts. `parts` has a part from 0 to num_parts - 1 for each of this rank's
    /// points.
    Ghosts count(const std::vector<rrcb::Part>& parts, int num_parts) const;

  private:
    MPI_Comm comm_;
    GhostRule rule_;
    double radius_;
    std::int64_t num_layers_;
    std::vector<std::size_t> sources_;  ///< local points to send; some are sent more than once
    rrcb::Plan plan_;
    std::vector<PointInCube> points_;  ///< points of this rank's layers and of those next to them
};

}  // namespace comparisons
