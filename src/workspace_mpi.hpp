#pragma once

#include "passes/open_points.hpp"

#include <mpi.h>

#include <vector>

namespace rrcb {

/// Memory for each point, which the calls on a communicator reuse.
///
/// A step may move an entry out. If it does not put the entry back, the memory is freed.
struct Workspace {
    OpenMemory open{};  ///< up to 12 bytes a point, 8 more for each coordinate and 8 more with
                        ///< weights
    std::vector<Part> result{};  ///< for calls from C, which copy the result out: 4 bytes a point
};

/// Returns the workspace of a duplicated communicator. It is made at the first call, and freed
/// with the communicator. Not collective. Throws Error or std::bad_alloc.
Workspace& workspace_of(MPI_Comm duplicate);

}  // namespace rrcb
