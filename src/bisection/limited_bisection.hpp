#pragma once

#include "cuts/cut_limits.hpp"

#include <rrcb/method/bisection.hpp>

namespace rrcb {

/// Bisects as bisect(), with all cuts at allowed places, for points in the box `points`.
///
/// Each cut is at the allowed place that comes nearest to the share of its parts: across its
/// preferred axis, or across another if that comes much nearer. The cuts below are not considered.
/// Throws Error if there is no room for the parts.
Bisection bisect_within(const Box& points, StatisticalDomain domain, const Options& options,
                        bool with_brackets);

/// Moves the cuts of an earlier call to allowed places. A cut without one across its axis gets the
/// longest axis that has one. Not collective. Throws Error if there is no room for the parts.
void move_into_places(const Box& points, const Options& options, Cuts& cuts);

}  // namespace rrcb
