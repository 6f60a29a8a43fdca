#pragma once

#include "bisection/profile.hpp"

#include <rrcb/cuts.hpp>

namespace rrcb {

/// Cut across the axis of a profile with the weight `target` below it, in a domain of some weight >
/// target >= 0.
///
/// The cumulative weight along an axis is piecewise cubic with jumps where patches have no
/// extent; where the target falls into a jump the patches of that jump are divided along the other
/// axes unless the cut is to be `plain`. Patches that can't be told apart go to the side that is
/// nearer to the target. Expected cost linear in the number of patches.
Cut weighted_quantile(const Profile& profile, double target, bool plain);

}  // namespace rrcb
