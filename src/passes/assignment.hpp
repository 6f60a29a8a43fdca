#pragma once

#include <rrcb/passes.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Totals of the local points at each end of the tree.
struct EndTotals : PartTotals {
    bool all_finite = true;  ///< coordinates; otherwise the rest is undefined
};

/// Finds the end of the tree for every point, see TreeShape. Returns whether all coordinates are
/// finite; otherwise the ends are undefined.
bool assign_ends(const Cuts& cuts, const Points& points, std::span<Part> ends);

/// Finds the end of the tree for every point, into `parts` (length points.count), and the totals of
/// each end, in one pass over the coordinates.
///
/// Memory depends only on the number of parts. Checks the coordinates, but not the lengths of the
/// arrays.
EndTotals assign_and_count(const Cuts& cuts, const Points& points, std::span<Part> parts);

/// Finds the part of every point that keeps it wherever each cut moves in its interval,
/// lower <= x <= upper across its axis, and no_part for the others. If `has_parts`, `parts` are
/// those by the cuts before. Returns the totals of the parts; checks nothing.
PartTotals assign_settled(const Cuts& cuts, std::span<const Bracket> intervals,
                          const Points& points, bool has_parts, std::span<Part> parts);

}  // namespace rrcb
