#pragma once

#include <rrcb/method/bisection.hpp>
#include <rrcb/passes.hpp>

#include <algorithm>
#include <vector>

namespace rrcb {

/// Returns the cuts of an earlier call, or those of them that this rank knows, fitted to complete
/// options: planes if asked for, and nothing in parts of size 0. They divide no coincident points,
/// which the look-up keeps together.
Cuts fitted(Cuts previous, const Options& options);

/// Adds brackets about cuts, as wide as estimated cuts of evenly spread points in `box` would have;
/// none if the box is empty. Takes memory for one per cut.
void bracket_earlier(const Cuts& cuts, const Box& box, std::vector<Bracket>& brackets);

/// Share of the local points near the cuts above them. A point near two cuts counts twice.
struct NearShare {
    double by_weight = 0;
    double by_count = 0;
    Vector spread{};  ///< mean distance of two points of a part, along each axis
};

/// Returns the number of points to sample on each rank for `all` on all ranks, or more on many.
inline LocalIndex sample_size(int all, int num_ranks) {
    return static_cast<LocalIndex>(std::max(256, all / num_ranks));
}

/// Counts the points of a sample within `reach` of the cuts, and measures their spread in the
/// parts; all 0 if `reach` is 0. Not collective.
NearShare near_share(const Cuts& cuts, const PointSample& sample, double reach);

}  // namespace rrcb
