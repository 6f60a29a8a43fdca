#pragma once

#include <rrcb/detail/passes.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Totals of this rank's points at each end of the tree.
struct EndTotals : PartTotals {
    bool all_finite = true;  ///< whether all coordinates are finite; if not, the rest is undefined
};

/// Finds the end of the tree of every point, see TreeShape. Returns whether all coordinates are
/// finite; if not, the ends are undefined.
bool assign_ends(const Cuts& cuts, const Points& points, std::span<Part> ends);

/// Writes the end of the tree of every point into `parts` (length points.count), and returns the
/// totals of each end. Reads the coordinates once.
///
/// Additional memory depends only on the number of parts. Checks the coordinates, but not the
/// lengths of the arrays.
EndTotals assign_and_count(const Cuts& cuts, const Points& points, std::span<Part> parts);

/// Finds the points that remain in their part wherever each cut ends in its interval, lower <= x <=
/// upper across its axis. Writes their part, and no_part for all other points. If `has_parts`,
/// `parts` contains the parts by the cuts before the call. Returns the totals of the parts; checks
/// nothing.
PartTotals assign_settled(const Cuts& cuts, std::span<const Bracket> intervals,
                          const Points& points, bool has_parts, std::span<Part> parts);

}  // namespace rrcb
