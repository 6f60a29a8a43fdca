#pragma once

#include "collective/participant.hpp"

#include <rrcb/plan.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// How many come to this rank, where each has `to`, of ascending ranks, for all of them.
///
/// Collective: one pass of a butterfly. Throws on every rank what failed on one before. A rank that
/// fails here may leave counts out that it has or hands on, until the next agreement.
LocalIndex count_arrivals(std::span<const RankCount> to, Participant& self);

/// How many come to this rank from which ones, ascending; otherwise as count_arrivals().
///
/// What contradicts the counts may follow from such a failure, see Participant::compare().
std::vector<RankCount> exchange_counts(std::span<const RankCount> to, Participant& self);

}  // namespace rrcb
