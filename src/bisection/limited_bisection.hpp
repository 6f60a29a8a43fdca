#pragma once

#include "bisection/profile.hpp"
#include "cuts/cut_limits.hpp"

#include <rrcb/detail/bisection.hpp>
#include <rrcb/detail/statistical_domain.hpp>

namespace rrcb {

/// A node and its domain.
struct Piece {
    StatisticalDomain domain;  ///< contains its patches
    Descent at;
    Box region;
    int depth;
};

/// Returns the cut of a piece with about the share `share` of its weight below it, at an allowed
/// position. If some cuts have an acceptable error, takes the one across the axis `usual`; if
/// `counts_near`, takes another one that has clearly less weight near it. If no cut has an
/// acceptable error, takes the one with the least error. Cuts further down in the tree are not
/// considered.
Cut cut_in_places(const Piece& piece, const Profile& profile, double share, int usual,
                  bool counts_near, const Options& options, CutLimits& limits);

/// Bisects as bisect(), but with all cuts at allowed positions, for points in the box `points`.
/// Throws Error if there is not enough room for the parts.
Bisection bisect_within(const Box& points, StatisticalDomain domain, const Options& options,
                        bool with_brackets, std::span<const int> preferred = {},
                        double* near_weight = nullptr);

/// Returns true if all cuts are at positions that the options allow for points in the box `points`.
/// Not collective.
bool are_in_places(const Box& points, const Cuts& cuts, const Options& options);

}  // namespace rrcb
