#pragma once

#include "workload_mpi.hpp"

#include <mpi.h>

#include <span>

namespace comparisons {

/// Returns the names of the clouds on which ghosts are compared, in 2-D and 3-D.
std::span<const char* const> ghost_clouds();

/// The number of points of a cloud, and the radius of its ghosts, in radii of GhostCounter.
inline constexpr rrcb::GlobalCount ghost_points = 20'000;
inline constexpr double ghost_reach = 3;

/// Prints the largest load of a part after each of several calls that correct the part sizes. The
/// load is points + cost * ghosts. Each rank has one part. Collective over `comm`.
void compare_loads(bool quick, MPI_Comm comm);

}  // namespace comparisons
