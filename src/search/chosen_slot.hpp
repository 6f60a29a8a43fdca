#pragma once

#include "search/cut_search.hpp"

#include <algorithm>
#include <span>

namespace rrcb {

/// Slot of the histogram that the cut falls into, with the points below it.
struct Chosen {
    int slot = 0;
    double below = 0;       ///< their weight
    GlobalCount count = 0;  ///< their number
};

/// Returns the slot for a target, given the weight and the number of points in each slot.
Chosen choose(const CutTarget& target, std::span<const double> weights,
              std::span<const double> counts);

/// Excess of a cut at either edge of a slot.
struct EdgeErrors {
    double lower;
    double upper;

    bool at_lower() const { return lower <= upper; }
    double least() const { return std::min(lower, upper); }
};

/// Returns the excess at the edges of the chosen slot, which holds `count` points of `weight`.
EdgeErrors errors_at(const Chosen& chosen, double weight, double count, const CutTarget& target);

}  // namespace rrcb
