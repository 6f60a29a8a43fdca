#pragma once

#include "collective/participant.hpp"
#include "zoltan/call/vote_mpi.hpp"
#include "zoltan/handle/state.hpp"

namespace rrcb::zoltan {

/// Gives the look-ups of `kept` all cuts, where `cuts` are spread over the ranks and any rank keeps
/// cuts.
///
/// Beyond 8192 parts the ranks of a machine share them. Collective where the cuts are spread;
/// throws Error on all ranks alike.
void show_all_cuts(const Outcome& outcome, const Cuts& cuts, State& state, KeptPartition& kept,
                   Participant& self);

/// The numbers of all boxes, of which each rank knows those of its own at least. Collective: two
/// reductions, one as long as there are parts; throws Error on all ranks alike.
Numbering whole_numbering(const Numbering& numbering, const PartMap& map, Participant& self);

}  // namespace rrcb::zoltan
