#pragma once

#include "passes/open_points.hpp"

#include <mpi.h>

#include <vector>

namespace rrcb {

/// Memory for each point, reused by the calls on a communicator.
///
/// A step may move an entry out. If it does not put the entry back, the memory is freed.
struct Workspace {
    OpenMemory open{};           ///< up to 8 bytes a point for each coordinate, 12, 8 weighted
    std::vector<Part> result{};  ///< of calls from C, which get a copy: 4 bytes a point
};

/// Returns the workspace of a duplicated communicator. It is made at the first call, and freed
/// with the communicator. Not collective. Throws Error or std::bad_alloc.
Workspace& workspace_of(MPI_Comm duplicate);

}  // namespace rrcb
