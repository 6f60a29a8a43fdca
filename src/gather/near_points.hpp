#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/passes.hpp>

namespace rrcb {

/// Share of the local points near the cuts above them. A point near two cuts counts twice.
struct NearShare {
    double by_weight = 0;
    double by_count = 0;
};

/// Counts the local points within `reach` of the cuts, `most` of them at random if there are more;
/// none if `reach` is 0. Not collective.
NearShare near_share(const Cuts& cuts, PointPasses& points, double reach, LocalIndex most);

}  // namespace rrcb
