#pragma once

#include "collective/butterfly.hpp"
#include "collective/participant.hpp"

#include <rrcb/plan.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Adds the counts for other ranks, which ascend, and for this one, before a pass to the owners of
/// a butterfly that keeps records apart. Throws std::bad_alloc.
void add_counts(std::span<const RankCount> to, Butterfly& butterfly);

/// Returns the counts of each rank that has some for this one, ascending, after the pass. Throws
/// std::bad_alloc.
std::vector<RankCount> counts_in(const Butterfly& butterfly);

/// Returns how many items this rank receives from each other rank. `to` are the numbers that it
/// sends. Both lists are by ascending rank. Joins `flags`, whose first is 0, to those of all ranks.
///
/// Collective: one pass of a butterfly. Throws on every rank the failure of one before the call. A
/// rank that fails in it may leave out counts that it has or passes on, until the next agreement.
/// So compare counts with other data in Participant::compare().
std::vector<RankCount> exchange_counts(std::span<const RankCount> to, Participant& self,
                                       Flags* flags = nullptr);

}  // namespace rrcb
