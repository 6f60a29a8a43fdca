#pragma once

#include "part_loads_mpi.hpp"

#include <mpi.h>

#include <cstdint>

namespace comparisons {

/// Points that are uniform in the unit cube, each of which goes straight on, in a direction of its
/// own, until the sides of the cube reflect it. The extents are nearly the same, so that the
/// longest axis is another one every few calls.
struct DriftingCube {
    std::int64_t num_points = 50'000;
    int num_times = 30;
    double speed = 0;  ///< sides from one time to the next
    std::uint64_t seed = 1;
};

/// The tracks of these points, of which each rank keeps about as many. They do not depend on the
/// number of ranks. Collective over `comm`.
PointTracks tracks_of(const DriftingCube& cube, MPI_Comm comm);

}  // namespace comparisons
