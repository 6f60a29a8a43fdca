#pragma once

#include "collective/participant.hpp"
#include "refinement/refinement_buffers.hpp"

#include <rrcb/bisection.hpp>

#include <limits>
#include <span>
#include <vector>

namespace rrcb {

/// What the refinement starts from; the same on every rank.
struct Estimate {
    Cuts cuts;
    std::vector<Bracket> brackets;  ///< one per cut
    double total_weight = 0;        ///< over all ranks
    double common_weight = 0;       ///< weight of each point where all weigh the same, else 0
    /// Of the parts that may stay instead; NaN where there are none.
    double current_imbalance = std::numeric_limits<double>::quiet_NaN();
};

/// How good the parts really are, and what it took to know; the same on every rank.
struct Measured {
    double imbalance = 1;
    std::vector<double> part_weights{};
    int rounds = 0;           ///< of counting and deciding
    int coincident_cuts = 0;  ///< that keep points together which the target divides
};

/// Moves the cuts of `estimate` until the parts of the real points are as even as asked.
///
/// Collective. `options` are complete, `room` is made by them. Writes the part of each point into
/// `parts`; where the estimate is not good enough, and the current parts neither, it works on a
/// sorted copy of the points. Where a tolerance is missed because slack was spent on upper levels
/// that lower ones need, it searches once more, exactly, and keeps the better cuts. Without weight
/// anywhere the cuts stay. A rank that fails on its own takes part with nothing until the root,
/// told of it by the next histograms or candidates, ends all searches; then all throw its error.
Measured refine(Estimate& estimate, const Options& options, const BinnedPoints& binned,
                RefinementBuffers& room, std::span<Part> parts, Participant& self);

}  // namespace rrcb
