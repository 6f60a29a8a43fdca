#pragma once

#include "collective/butterfly.hpp"
#include "collective/participant.hpp"

#include <rrcb/plan.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Adds the numbers of items for other ranks, in ascending order, and for this rank to a butterfly
/// that keeps records apart, before the pass to the owners. Throws std::bad_alloc.
void add_counts(std::span<const RankCount> to, Butterfly& butterfly);

/// After the pass, returns the number of items from each rank that has some for this one, in
/// ascending order. Throws std::bad_alloc.
std::vector<RankCount> counts_in(const Butterfly& butterfly);

/// Returns how many items this rank receives from each other rank; `to` contains how many it sends.
/// Both lists are in ascending order of ranks. Joins `flags`, whose first entry must be 0, with
/// those of all ranks.
///
/// Collective: one pass of a butterfly. If a rank failed before the call, every rank throws its
/// failure. If a rank fails in the call, counts that it has or passes on may be missing until the
/// next agreement. Therefore compare counts with other data only in Participant::compare().
std::vector<RankCount> exchange_counts(std::span<const RankCount> to, Participant& self,
                                       Flags* flags = nullptr);

}  // namespace rrcb
