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

/// Returns the number of points to sample on each rank for a comparison of cuts.
inline LocalIndex sample_size(int num_ranks) {
    return std::max<LocalIndex>(1024, (1 << 13) / static_cast<LocalIndex>(num_ranks));
}

/// Counts the points of a sample within `reach` of the cuts, and measures their spread in the
/// parts; all 0 if `reach` is 0. Not collective.
NearShare near_share(const Cuts& cuts, const PointSample& sample, double reach);

}  // namespace rrcb
