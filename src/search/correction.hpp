#pragma once

#include "search/undecided_points.hpp"

namespace rrcb {

/// Writes the corrected places of all cuts that move into `values`, in the order of their slabs.
///
/// `part_weights` and `counts` are those of all ranks by the current cuts; `part_weights` becomes
/// the expected weights. Cuts are corrected from the root of the tree down. Each moves the weights
/// in its bins between the parts below. Points in several slabs, and positions within a bin, are
/// unknown, so a second, smaller correction may be needed. Does not allocate.
void correct(const TargetRule& rule, const Cuts& cuts, std::span<const Slab> slabs,
             std::span<double> part_weights, std::span<const double> counts,
             std::span<double> values);

}  // namespace rrcb
