#pragma once

#include "search/undecided_points.hpp"

namespace rrcb {

/// Where all cuts that move are to lie, as far as counts tell, into `values` in the order of their
/// slabs.
///
/// `part_weights` and `counts` are those of all ranks by the cuts as they are. The cuts are
/// corrected from the root of the tree on, and each brings along into the parts below what its bins
/// tell. What lies in several slabs at once, and where in a bin, is not known; so a second
/// correction may be needed, which has less to move. `part_weights` becomes what is expected of it.
/// Takes no memory.
void correct(const TargetRule& rule, const Cuts& cuts, std::span<const Slab> slabs,
             std::span<double> part_weights, std::span<const double> counts,
             std::span<double> values);

}  // namespace rrcb
