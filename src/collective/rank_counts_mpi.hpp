#pragma once

#include "collective/butterfly.hpp"
#include "collective/participant.hpp"

#include <rrcb/plan.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Returns how many items this rank receives, if it sends `to`, by ascending rank.
///
/// Collective: one pass of a butterfly. Throws on every rank the failure of one before the call. A
/// rank that fails in it may leave out counts that it has or passes on, until the next agreement.
LocalIndex count_arrivals(std::span<const RankCount> to, Participant& self);

/// As count_arrivals(), but returns the number from each rank, ascending. Joins `flags`, of which
/// the first is 0, to those of all ranks.
///
/// Such a failure may make counts contradict other data, so compare them in Participant::compare().
std::vector<RankCount> exchange_counts(std::span<const RankCount> to, Participant& self,
                                       Flags* flags = nullptr);

}  // namespace rrcb
