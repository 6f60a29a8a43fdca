#pragma once

#include "search/undecided_points.hpp"

namespace rrcb {

/// Writes the corrected places of all cuts that move into `values`, in the order of their slabs.
///
/// `part_weights` and `counts` are those of all ranks by the cuts as they are; `part_weights`
/// becomes the expected weights. Cuts are corrected from the root of the tree on. Each moves the
/// weights in its bins between the parts below. Points in several slabs at once, and positions
/// within a bin, are unknown; a second correction may therefore be needed, which has less to move.
/// Allocates no memory.
void correct(const TargetRule& rule, const Cuts& cuts, std::span<const Slab> slabs,
             std::span<double> part_weights, std::span<const double> counts,
             std::span<double> values);

}  // namespace rrcb
