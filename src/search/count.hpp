#pragma once

#include "passes/bins.hpp"
#include "passes/histogram.hpp"
#include "search/collected_tree.hpp"

#include <span>

namespace rrcb {

/// Adds collected points to a histogram: weights and counts in bins across an axis, and extents.
void count(const Collected& collected, const Entries& entries, int axis, const Bins& bins,
           const HistogramLayout& layout, std::span<double> histogram);

/// Adds settled points, which are in `box`, to a slot of a histogram.
void count_settled(const Total& total, const Box& box, int slot, const HistogramLayout& layout,
                   std::span<double> histogram);

/// Rounds the weights in a histogram to multiples of a quantum.
void round_weights(double quantum, const HistogramLayout& layout, std::span<double> histogram);

/// Returns the entries from `lower` to below `upper` across an axis.
Entries between(double lower, double upper, int axis, const Entries& entries,
                const Collected& collected);

}  // namespace rrcb
