#pragma once

#include "collective/participant.hpp"

#include <rrcb/passes.hpp>

#include <span>

namespace rrcb {

/// Returns true if so much weight is near earlier cuts, compared with the time when their axes were
/// chosen, that others may save ghosts.
bool may_save_ghosts(const Options& options, const NearCuts& chosen, double share_now);

/// Returns the share of reference for later calls, if the axes are kept: that of the chosen axes,
/// or less since. It falls by four times the `excess` of the imbalance that cuts were moved for,
/// because other axes may have become better meanwhile.
double reference(const NearCuts& chosen, double share_now, double excess);

/// Returns the better balance: that from scratch if its balance is worth moving points, or if
/// `compares_ghosts` and it has much fewer points near its cuts; otherwise the points get back
/// their `parts` by the cuts reused. Collective.
Balance better(Balance&& reused, std::span<const Part> parts, Balance&& anew, PointPasses& points,
               const Options& options, bool compares_ghosts, Participant& self);

}  // namespace rrcb
