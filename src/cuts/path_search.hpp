#pragma once

#include "cuts/tier_search.hpp"

#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Finds the parts of points by cuts that are distributed over the ranks.
class PathSearch : public TierSearch {
  public:
    /// Takes points whose `parts` were found by `known`, or are unknown_below() a node. The points
    /// and their parts outlive it.
    PathSearch(const Cuts& known, const Points& points, std::span<Part> parts);

    /// Follows the points with the cuts received, and asks for the missing ones. Returns whether
    /// any are missing.
    bool ask(Butterfly& asked);

    /// Returns the points whose parts were unknown at first.
    std::span<const LocalIndex> searched() const { return searched_; }

  private:
    const Points& points_;
    std::span<Part> parts_;
    std::vector<LocalIndex> searched_;
    std::vector<LocalIndex> left_;  ///< of these, those whose parts are still unknown
};

}  // namespace rrcb
