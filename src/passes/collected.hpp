#pragma once

#include <rrcb/passes.hpp>

#include <span>
#include <vector>

namespace rrcb {

// Collecting from the host's arrays; see PointPasses for the contracts.

/// Collects as PointPasses::collect(), in two passes. Throws std::bad_alloc.
void collect(const Points& points, const Cuts& cuts, std::span<const Bracket> intervals,
             bool has_parts, std::span<Part> parts, Collected& collected);

/// Collects all points, without totals. Throws std::bad_alloc.
void collect_all(const Points& points, Collected& collected);

/// Collects as PointPasses::collect_more(), in a pass. Throws std::bad_alloc.
std::vector<std::size_t> collect_more(const Points& points, std::span<const Wanted> wanted,
                                      std::span<Part> parts, Collected& collected);

/// Returns the box of the points of each part, but for those without one. A pass.
std::vector<Box> boxes_of_parts(const Points& points, std::span<const Part> parts, int num_parts);

}  // namespace rrcb
