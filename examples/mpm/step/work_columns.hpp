#pragma once

#include "transfer/transfers.hpp"

#include <span>
#include <vector>

namespace mpm {

/// Parts of each point in the columns of Simulation::work_columns(), row after row.
///
/// The points of a run share it, and those that reach a node share that. An empty node is given to
/// the nearest one that is reached: behind a cut it goes with the points on the same side.
template <int D>
std::vector<double> point_columns(const GridPatch<D>& patch, std::span<const CellRun<D>> runs);

}  // namespace mpm
