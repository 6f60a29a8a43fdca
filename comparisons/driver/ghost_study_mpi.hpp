#pragma once

#include "row.hpp"
#include "workload_mpi.hpp"

#include <mpi.h>

#include <span>
#include <string>
#include <vector>

namespace comparisons {

/// Names of the clouds on which ghosts are compared, in 2-D and 3-D.
std::span<const char* const> ghost_clouds();

/// Number of points of a cloud and the radius of its ghosts, over that of GhostCounter.
inline constexpr rrcb::GlobalCount ghost_points = 20'000;
inline constexpr double ghost_reach = 3;

/// Prints a row of the one table of the program on rank 0, before the first its header.
void print(const Row& row, MPI_Comm comm);

/// Prints the largest loads of parts, points + a cost * ghosts, as part sizes are corrected call by
/// call; a part for each rank. Collective over `comm`.
void compare_loads(bool quick, MPI_Comm comm);

}  // namespace comparisons
