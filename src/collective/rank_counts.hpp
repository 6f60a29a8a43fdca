#pragma once

#include "collective/butterfly.hpp"

#include <rrcb/plan.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Sends counts to ranks in a butterfly: the part of one rank, without the messages.
class RankCounts {
  public:
    /// Determines whether a rank gets the sum of its counts, or the count from each rank.
    enum Kind { sum, each };

    /// Not collective. Never throws.
    RankCounts(Kind kind, int rank, int num_ranks);

    /// Takes the counts for other ranks, which ascend, and for this one. Throws std::bad_alloc.
    void add(std::span<const RankCount> to);

    /// Returns the butterfly, which sends the counts in one pass.
    Butterfly& butterfly() { return butterfly_; }

    /// Returns the sum of the counts received.
    LocalIndex total() const;

    /// Returns the counts of each rank that has some, ascending. Throws std::bad_alloc.
    std::vector<RankCount> from() const;

  private:
    Kind kind_;
    Butterfly butterfly_;
};

}  // namespace rrcb
