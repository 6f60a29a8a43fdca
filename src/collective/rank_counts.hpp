#pragma once

#include "collective/butterfly.hpp"

#include <rrcb/plan.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Counts that ranks have for each other on their way there, in a butterfly: one rank's part in it,
/// without the messages.
class RankCounts {
  public:
    /// Determines whether a rank gets the sum of its counts, or the count from each rank.
    enum Kind { sum, each };

    /// Not collective. Never throws.
    RankCounts(Kind kind, int rank, int num_ranks);

    /// Takes the counts for other ranks, which ascend, and for this one. Throws std::bad_alloc.
    void add(std::span<const RankCount> to);

    /// Takes them to their ranks in one pass.
    Butterfly& butterfly() { return butterfly_; }

    /// Returns the sum of the counts that have come.
    LocalIndex total() const;

    /// Returns the counts of each rank that has some, ascending. Throws std::bad_alloc.
    std::vector<RankCount> from() const;

  private:
    Kind kind_;
    Butterfly butterfly_;
};

}  // namespace rrcb
