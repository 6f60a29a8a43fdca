#pragma once

#include <rrcb/cuts.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// What one rank's points add up to in each part, or in those that `parts` names.
struct PartTotals {
    std::vector<double> weights;  ///< one per part
    std::vector<double> counts;   ///< one per part
    std::vector<Part> parts{};    ///< what each entry is of; empty: entry p of part p
    bool all_finite = true;       ///< no coordinate is NaN or infinite; otherwise the rest is void
};

/// End of the tree for every point, see TreeShape, or unknown_below() a node that is not known.
/// Returns whether all coordinates are finite; otherwise the parts are void.
bool assign_known(const Cuts& cuts, const Points& points, std::span<Part> parts);

/// End of the tree for every point, into `parts` (length points.count), and what each end holds:
/// in one pass over the coordinates, without cells.
///
/// Takes memory by the number of parts alone, or by that of the known cuts. By cuts that are not
/// all known each part below a node that is not known is unknown_below() it, in `parts` and in the
/// totals, which name no part twice. The lengths of the arrays have been checked, the
/// coordinates need not have been.
PartTotals assign_and_count(const Cuts& cuts, const Points& points, std::span<Part> parts);

}  // namespace rrcb
