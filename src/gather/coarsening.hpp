#pragma once

#include "gather/cell_records.hpp"

namespace rrcb {

/// Merges cells on the finest lattice on which at most `most` (>= 8) are left, in its order.
///
/// The lattice is never finer than one on which they were merged before. The same cells in the same
/// order give the same bits. Not collective.
CellSet coarsen(const CellSet& set, int dimension, std::size_t most);

}  // namespace rrcb
