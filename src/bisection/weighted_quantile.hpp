#pragma once

#include "bisection/profile.hpp"

#include <rrcb/cuts.hpp>

namespace rrcb {

/// Returns the cut across an axis of a domain with the weight `target` below it, from 0 up to, not
/// including, the weight of the domain.
///
/// The cumulative weight along an axis is piecewise cubic, with jumps at patches without extent. If
/// the target falls into a jump, its patches are divided along the other axes, unless `plain`.
/// Coincident patches go to the side with the smaller error. Expected cost linear in the number of
/// patches.
Cut weighted_quantile(const Profile& profile, int axis, double target, bool plain);

}  // namespace rrcb
