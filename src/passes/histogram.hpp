#pragma once

#include "cuts/axis_limits.hpp"
#include "passes/bins.hpp"

#include <rrcb/detail/passes.hpp>

#include <cstddef>
#include <span>

namespace rrcb {

/// Indices of collected points.
using Entries = detail::Uninitialized<LocalIndex>;

/// Weight and number of points.
struct Total {
    double weight = 0;
    double count = 0;

    friend Total operator+(const Total& a, const Total& b) {
        return {a.weight + b.weight, a.count + b.count};
    }
};

/// Layout of a histogram: the numbers that a rank sends about one search in a round.
///
/// The first num_extents entries are joined by their maximum: the negative lower ends and the upper
/// ends of the points' extent. Then follow the weights of all slots, unless every point counts as
/// 1, and the numbers of points of all slots; these are joined by their sum.
struct HistogramLayout {
    int num_bins = 64;
    bool is_weighted = true;
    std::array<AxisLimits, max_dimension> limits{};  ///< grids whose lines are the edges of bins

    std::size_t num_slots() const { return static_cast<std::size_t>(num_bins) + 2; }
    static constexpr std::size_t num_extents = std::size_t{2} * max_dimension;
    std::size_t first_count() const { return num_extents + (is_weighted ? num_slots() : 0); }
    std::size_t length() const { return first_count() + num_slots(); }
};

void clear_histogram(std::span<double> histogram);

inline std::span<double> sums_in(std::span<double> histogram) {
    return histogram.subspan(HistogramLayout::num_extents);
}

inline std::span<const double> weights_in(std::span<const double> histogram,
                                          const HistogramLayout& layout) {
    return histogram.subspan(HistogramLayout::num_extents, layout.num_slots());
}

inline std::span<const double> counts_in(std::span<const double> histogram,
                                         const HistogramLayout& layout) {
    return histogram.subspan(layout.first_count(), layout.num_slots());
}

/// Adds collected points to a histogram: weights and counts in bins across an axis, and the extent.
void count(const Collected& collected, const Entries& entries, int axis, const Bins& bins,
           const HistogramLayout& layout, std::span<double> histogram);

/// Adds collected points to the sums of a histogram across an axis, but not to its extent.
void count_sums(const Collected& collected, const Entries& entries, int axis, const Bins& bins,
                const HistogramLayout& layout, std::span<double> sums);

/// Adds the total of settled points in a box to a slot.
void count_settled(const Total& total, const Box& box, int slot, const HistogramLayout& layout,
                   std::span<double> histogram);

/// Rounds the weights in the sums of a histogram to multiples of a quantum.
void round_weights(double quantum, const HistogramLayout& layout, std::span<double> sums);

/// Joins the histogram of other ranks. If weights are multiples of a common quantum, any order
/// gives bit-identical sums.
void join_histograms(std::span<const double> other, std::span<double> histogram);

/// Returns the entries with lower <= x < upper across an axis.
Entries between(double lower, double upper, int axis, const Entries& entries,
                const Collected& collected);

}  // namespace rrcb
