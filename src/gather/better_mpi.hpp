#pragma once

#include "collective/participant.hpp"

#include <rrcb/balance.hpp>

namespace rrcb {

/// Returns true if so much weight is near earlier cuts, compared with the time when their axes were
/// chosen, that others may save ghosts.
bool may_save_ghosts(const Options& options, const NearCuts& chosen, double share_now);

/// Returns the share to compare with in later calls, if the cuts are kept: that of the chosen axes,
/// or less since, or about that of now if new cuts were compared in this call.
double reference(const NearCuts& chosen, double share_now, bool was_compared);

/// Returns the better balance: that from scratch if its balance is worth moving points, or if
/// `compares_ghosts` and it has much fewer points near its cuts. Collective.
Balance better(Balance&& reused, Balance&& anew, const Points& points, const Options& options,
               bool compares_ghosts, const Participant& self);

}  // namespace rrcb
