#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/passes.hpp>

namespace rrcb {

/// Share of the local points near the cuts above them. A point near two cuts counts twice.
struct NearShare {
    double by_weight = 0;
    double by_count = 0;
    Vector spread{};  ///< mean distance of two points of a part, along each axis
};

/// Counts the local points within `reach` of the cuts, and measures their spread in the parts, from
/// `most` of them at random if there are more; all 0 if `reach` is 0. Not collective.
NearShare near_share(const Cuts& cuts, PointPasses& points, double reach, LocalIndex most);

}  // namespace rrcb
