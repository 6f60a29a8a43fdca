#pragma once

#include "gather/place.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>

#include <optional>
#include <span>
#include <vector>

namespace rrcb {

/// The distribution that the ranks hold, as a bisection.
struct CurrentParts {
    Cuts cuts;
    std::vector<Part> parts;           ///< of each rank's points
    std::vector<double> part_weights;  ///< by count where all weights are 0
    double imbalance = 1;
};

/// Reads the places of the ranks, one each, as a bisection into the parts that the complete
/// `options` ask for, one per rank; nothing where they are none. Not collective.
///
/// The cuts give each point the part of its rank, but for those in one place that a cut divides,
/// which has to be allowed. Rank r holds part r where that is possible; otherwise, and where no
/// rank is without points, parts go to the ranks in any order, as where they were renumbered.
///
/// A cut counts where a new one might lie as well: across the axis of the cut in `estimate`, with
/// those above it, or a long axis of what it divides. So slabs of a cube are no bisection, and a
/// box whose sides are nearly the same is one either way. Limited cuts count across any axis, if
/// there are places for them between the ranks.
std::optional<CurrentParts> read_current(std::span<const Place> places, const Cuts& estimate,
                                         const Options& options);

}  // namespace rrcb
