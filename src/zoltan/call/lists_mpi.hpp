#pragma once

#include "collective/exchange_mpi.hpp"
#include "zoltan/call/lists.hpp"

namespace rrcb::zoltan {

/// Makes the lists that RETURN_LISTS asks for. Leaves imports out if no object on any rank
/// `changes` its rank or part. Imports are ordered by the exporting rank, and then as in the list
/// of that rank. Messages use `memory`, which grows.
///
/// Collective over `self.comm` if imports are asked for, as Exchange is, with one reduction. If a
/// rank has no memory, throws Error on all ranks; if a message fails, throws Error on its rank
/// only.
Lists select_lists(const Parameters& parameters, const Moves& moves, bool changes,
                   ExchangeBuffers& memory, Participant& self);

}  // namespace rrcb::zoltan
