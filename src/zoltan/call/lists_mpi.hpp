#pragma once

#include "collective/exchange_mpi.hpp"
#include "zoltan/call/lists.hpp"

namespace rrcb::zoltan {

/// Drops the lists or completes them as RETURN_LISTS asks, where any object `changes` its rank:
/// with the import list that answers the export lists of all ranks, by rank, in the order of that
/// rank's list. They travel in `memory`, which grows.
///
/// Collective over `self.comm` where imports are asked for, as Exchange is, with a reduction.
/// Throws Error on all ranks where one has no memory, on one alone where its message fails.
void select_lists(const Parameters& parameters, bool changes, ExchangeBuffers& memory,
                  Participant& self, List& imports, List& exports);

}  // namespace rrcb::zoltan
