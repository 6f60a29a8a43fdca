#pragma once

#include "cuts/axis_limits.hpp"

#include <rrcb/points.hpp>

#include <cstddef>
#include <span>

namespace rrcb {

/// Layout of a histogram, the data of one search in a round: weights and counts in the slots of a
/// bracket.
///
/// The first num_extents entries are joined by their maximum: minus the lower ends of the extent,
/// and its upper ends. They are followed by the weights, unless points count as 1, and the counts
/// of all slots, to be summed.
struct HistogramLayout {
    int num_bins = 64;
    bool is_weighted = true;
    std::array<AxisLimits, max_dimension> limits{};  ///< of the grids on whose lines bins have
                                                     ///< their edges

    std::size_t num_slots() const { return static_cast<std::size_t>(num_bins) + 2; }
    static constexpr std::size_t num_extents = std::size_t{2} * max_dimension;
    std::size_t first_count() const { return num_extents + (is_weighted ? num_slots() : 0); }
    std::size_t length() const { return first_count() + num_slots(); }
};

void clear_histogram(std::span<double> histogram);

inline std::span<const double> weights_in(std::span<const double> histogram,
                                          const HistogramLayout& layout) {
    return histogram.subspan(HistogramLayout::num_extents, layout.num_slots());
}

inline std::span<const double> counts_in(std::span<const double> histogram,
                                         const HistogramLayout& layout) {
    return histogram.subspan(layout.first_count(), layout.num_slots());
}

/// Joins the histogram of other ranks. Any order gives the same bits if weights
/// are multiples of a common quantum.
void join_histograms(std::span<const double> other, std::span<double> histogram);

}  // namespace rrcb
