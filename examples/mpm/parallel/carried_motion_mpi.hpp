#pragma once

#include "grid/grid.hpp"

#include <mpi.h>

#include <span>

namespace mpm {

/// Hands the motion of the last step's nodes to the ranks that have them next. Collective over
/// `comm`, with messages only between ranks of which one gains nodes of the other.
///
/// `before` and `after` are the patches of all ranks. `patch` is this rank's after, and `last` the
/// motion of its patch before. Of the ranks that had a node the lowest hands it on. A node that no
/// rank had rests.
template <int D>
void carry_motion(std::span<const NodeRange<D>> before, std::span<const NodeRange<D>> after,
                  std::span<const NodeMotion<D>> last, GridPatch<D>& patch, MPI_Comm comm);

}  // namespace mpm
