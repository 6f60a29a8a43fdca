#pragma once

#include "arithmetic/position_order.hpp"
#include "search/cut_search.hpp"

#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// A point that may still end on either side of a cut.
struct Candidate {
    Vector position{};
    double weight = 0;
};

/// Reads candidates from records of position and weight.
std::vector<Candidate> read_candidates(std::span<const double> records, int dimension);

/// Candidates at one position, and the points below them.
struct Ties {
    GlobalCount begin = 0;  ///< number of the points below
    GlobalCount count = 0;
    double below = 0;
    double weight = 0;
};

/// Candidates in two groups: those below the cut come first.
struct Division {
    GlobalCount count = 0;  ///< points of the node below the cut
    double below = 0;       ///< their weight
    Ties ties;              ///< candidates that hold the target, if there are several
};

/// Returns the division with the least excess of sorted candidates, all above the base of the
/// target.
Division best_division(std::span<const Candidate> sorted, const PositionOrder& before,
                       const CutTarget& target);

}  // namespace rrcb
