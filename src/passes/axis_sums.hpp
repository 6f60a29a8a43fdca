#pragma once

#include "passes/bins.hpp"

#include <rrcb/passes.hpp>

#include <span>

namespace rrcb {

/// Adds collected points to the sums along an axis: the weights, unless points count as 1, and the
/// counts in all slots.
void add_along(int axis, const Bins& bins, const Collected& points,
               std::span<const LocalIndex> entries, bool is_weighted, std::span<double> sums);

}  // namespace rrcb
