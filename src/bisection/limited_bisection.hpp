#pragma once

#include "bisection/profile.hpp"
#include "cuts/cut_limits.hpp"

#include <rrcb/method/bisection.hpp>
#include <rrcb/method/statistical_domain.hpp>

namespace rrcb {

/// A node and its domain.
struct Piece {
    StatisticalDomain domain;  ///< of patches
    Descent at;
    Box region;
    int depth;
};

/// Returns the cut of a piece with the share `share` of its weight below. Among the cuts with a
/// bearable error it is the one across the `usual` axis or, if it `counts_near`, with clearly less
/// weight near it. If there is none, it is the cut with the least error. The cuts
/// below are not considered.
Cut cut_in_places(const Piece& piece, const Profile& profile, double share, int usual,
                  bool counts_near, const Options& options, CutLimits& limits);

/// Bisects as bisect(), with all cuts at allowed places, for points in the box `points`. Throws
/// Error if there is no room for the parts.
Bisection bisect_within(const Box& points, StatisticalDomain domain, const Options& options,
                        bool with_brackets, std::span<const int> preferred = {},
                        double* near_weight = nullptr);

/// Returns true if cuts are at allowed places for points in the box `points`. Not collective.
bool are_in_places(const Box& points, const Cuts& cuts, const Options& options);

}  // namespace rrcb
