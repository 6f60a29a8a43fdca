#pragma once

#include <rrcb/cuts.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// What one rank's points add up to in each part.
struct PartTotals {
    std::vector<double> weights;  ///< one per part
    std::vector<double> counts;   ///< one per part
    bool all_finite = true;       ///< no coordinate is NaN or infinite; otherwise the rest is void
};

/// Part of every point by the cuts, into `parts` (length points.count), as the look-up has it, and
/// what each part holds: in one pass over the coordinates, without cells.
///
/// Takes memory by the number of parts alone. The lengths of the arrays have been checked, the
/// coordinates need not have been.
PartTotals assign_and_count(const Cuts& cuts, const Points& points, std::span<Part> parts);

}  // namespace rrcb
