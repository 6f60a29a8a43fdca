#pragma once

#include "bisection/profile.hpp"

#include <rrcb/cuts.hpp>

namespace rrcb {

/// Returns the cut across an axis with the weight `target` below it. The target is at least 0 and
/// less than the weight of the domain.
///
/// The cumulative weight along an axis is piecewise cubic, with jumps at patches without extent. If
/// the target is inside a jump, the patches of the jump are divided along the other axes, unless
/// `plain`. Coincident patches all go to the side that gives the smaller error. The expected cost
/// is linear in the number of patches.
Cut weighted_quantile(const Profile& profile, int axis, double target, bool plain);

}  // namespace rrcb
