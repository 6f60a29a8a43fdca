#pragma once

#include "collective/participant.hpp"
#include "zoltan/call/vote_mpi.hpp"
#include "zoltan/handle/state.hpp"

namespace rrcb::zoltan {

/// Returns the numbers of all boxes, of which each rank knows those of its own at least.
/// Collective: two reductions, one of them with an entry for each part; throws Error on all ranks
/// alike.
Numbering whole_numbering(const Numbering& numbering, const PartMap& map, Participant& self);

}  // namespace rrcb::zoltan
