#pragma once

#include "collective/member.hpp"

#include <rrcb/balance.hpp>

namespace rrcb {

/// As the public functions, over a communicator that is a duplicate already; `previous` may be
/// null. What went wrong on a rank before is told to all as well; of `options` only the domain
/// counts there.
Balance balance(const Points& points, const Options& options, const Cuts* previous, Member& me);

}  // namespace rrcb
