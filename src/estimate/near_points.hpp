#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/passes.hpp>

#include <algorithm>

namespace rrcb {

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
