#pragma once

#include "grid/grid.hpp"

#include <mpi.h>

#include <span>

namespace mpm {

/// Hands the motion of the last step's nodes to the ranks that have them next. Collective over
/// `comm`.
///
/// `before` and `after` are the patches of all ranks. `from` is this rank's patch before; `to` is
/// its patch after, whose motion is replaced. A node that no rank had rests.
template <int D>
void carry_motion(std::span<const NodeRange<D>> before, std::span<const NodeRange<D>> after,
                  const GridPatch<D>& from, GridPatch<D>& to, MPI_Comm comm);

}  // namespace mpm
