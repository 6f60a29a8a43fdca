#pragma once

#include "collective/participant.hpp"

#include <rrcb/plan.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Returns how many come to this rank, if each rank has `to`, of ascending ranks, for the others.
///
/// Collective: one pass of a butterfly. Throws on every rank the failure of one before the call. A
/// rank that fails in it may leave out counts that it has or passes on, until the next agreement.
LocalIndex count_arrivals(std::span<const RankCount> to, Participant& self);

/// Returns how many come to this rank from each rank, ascending; otherwise as count_arrivals().
///
/// A contradiction to the counts may follow from such a failure, see Participant::compare().
std::vector<RankCount> exchange_counts(std::span<const RankCount> to, Participant& self);

}  // namespace rrcb
