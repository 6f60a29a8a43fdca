#pragma once

#include "collective/exchange_mpi.hpp"
#include "zoltan/call/lists.hpp"

namespace rrcb::zoltan {

/// Makes the lists asked for by RETURN_LISTS, without imports if no object of any rank `changes`
/// its rank or part. Imports answer the export lists of all ranks, by rank, in the order of that
/// rank's list. Messages use `memory`, which grows.
///
/// Collective over `self.comm` if imports are asked for, as Exchange is, with a reduction. Throws
/// Error on all ranks if one has no memory, on one alone if its message fails.
Lists select_lists(const Parameters& parameters, const Moves& moves, bool changes,
                   ExchangeBuffers& memory, Participant& self);

}  // namespace rrcb::zoltan
