#pragma once

#include "collective/participant.hpp"

#include <rrcb/balance.hpp>

namespace rrcb {

/// As the public functions, over a communicator that is a duplicate already; `previous` may be
/// null. What went wrong on a rank before is told to all as well; of `options` only the domain
/// counts there. The points stay where they are good enough (Report::kept) only if all ranks allow
/// it: if `may_stay`, which may differ between them.
Balance balance(const Points& points, const Options& options, const Cuts* previous, bool may_stay,
                Participant& self);

}  // namespace rrcb
