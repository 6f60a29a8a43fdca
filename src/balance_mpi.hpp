#pragma once

#include "collective/participant.hpp"

#include <rrcb/balance.hpp>

namespace rrcb {

/// Balances as the public functions do, over a communicator that is a duplicate already.
///
/// `previous` may be null. A failure from before the call is thrown on all ranks as well. Points
/// that lie well enough stay (Report::kept) only if all ranks allow it: `may_keep` may differ
/// between them.
Balance balance(const Points& points, const Options& options, const Cuts* previous, bool may_keep,
                Participant& self);

}  // namespace rrcb
