#pragma once

#include "cuts/cut_limits.hpp"

#include <rrcb/bisection.hpp>

namespace rrcb {

/// As bisect(), with all cuts in their places, of points in the box `points`.
///
/// Where the places next to the shares of the parts leave these too uneven, other axes and places
/// are tried, each with what the cuts below can then do, as far as a few tens of milliseconds go.
/// Throws Error where there is no room for the parts.
Bisection bisect_within(const Box& points, StatisticalDomain domain, const Options& options,
                        bool with_brackets);

/// Share of the weight of each node that lies below its cut, in preorder, by what the parts weigh;
/// that of their sizes where it is the same but for rounding.
std::vector<double> planned_shares(std::span<const double> part_weights,
                                   std::span<const double> part_sizes);

/// Moves the cuts of an earlier call into their places; across the longest extent that has any
/// where their own axis has none. Not collective. Throws Error where there is no room for the
/// parts.
void move_into_places(const Box& points, const Options& options, Cuts& cuts);

}  // namespace rrcb
