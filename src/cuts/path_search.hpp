#pragma once

#include "cuts/tier_search.hpp"

#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Search of the parts of points by cuts of which each rank knows some.
class PathSearch : public TierSearch {
  public:
    /// Of points whose `parts` are told by `known`, or unknown_below() a node. The points and their
    /// parts outlive it.
    PathSearch(const Cuts& known, const Points& points, std::span<Part> parts);

    /// Follows the points with the cuts that have come, and asks for those that it lacks. Returns
    /// whether there are any.
    bool ask(Butterfly& asked);

    /// Points whose parts were not known at first.
    std::span<const LocalIndex> searched() const { return searched_; }

  private:
    const Points& points_;
    std::span<Part> parts_;
    std::vector<LocalIndex> searched_;
    std::vector<LocalIndex> left_;  ///< of them, those whose parts are not known yet
};

}  // namespace rrcb
