#pragma once

#include "collective/participant.hpp"

#include <rrcb/balance.hpp>

namespace rrcb {

/// Returns true if so much weight is near earlier cuts, compared with the time when their axes were
/// chosen, that others may save ghosts.
bool may_save_ghosts(const Options& options, const NearCuts& chosen, double share_now);

/// Returns the share to compare with in later calls, if the axes are kept: that of the chosen axes,
/// or less since, or that of now if new cuts were compared in this call. It falls with every call
/// that moves cuts, so that new cuts are compared after some of them at least.
double reference(const NearCuts& chosen, double share_now, bool was_compared, bool were_moved);

/// Returns the better balance: that from scratch if its balance is worth moving points, or if
/// `compares_ghosts` and it has much fewer points near its cuts. Collective.
Balance better(Balance&& reused, Balance&& anew, const Points& points, const Options& options,
               bool compares_ghosts, const Participant& self);

}  // namespace rrcb
