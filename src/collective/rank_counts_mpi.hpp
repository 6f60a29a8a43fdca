#pragma once

#include "collective/butterfly.hpp"
#include "collective/participant.hpp"

#include <rrcb/plan.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Sends counts to ranks in one pass of a butterfly: the part of one rank, without the messages.
class RankCounts {
  public:
    /// Determines whether a rank gets the sum of its counts, or the count from each rank.
    enum Kind { sum, each };

    /// Not collective. Never throws.
    RankCounts(Kind kind, int rank, int num_ranks);

    /// Takes the counts for other ranks, which ascend, and for this one. Throws std::bad_alloc.
    void add(std::span<const RankCount> to);

    Butterfly& butterfly() { return butterfly_; }

    /// Returns the sum of the counts received.
    LocalIndex total() const;

    /// Returns the counts of each rank that has some, ascending. Throws std::bad_alloc.
    std::vector<RankCount> from() const;

  private:
    Kind kind_;
    Butterfly butterfly_;
};

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
