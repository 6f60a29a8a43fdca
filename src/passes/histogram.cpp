#include "passes/histogram.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace rrcb {

void clear_histogram(std::span<double> histogram) {
    std::ranges::fill(histogram, 0.0);
    std::ranges::fill(histogram.first(HistogramLayout::num_extents),
                      -std::numeric_limits<double>::infinity());
}

void join_histograms(std::span<const double> other, std::span<double> histogram) {
    constexpr std::size_t num_extents = HistogramLayout::num_extents;
    for (std::size_t k = 0; k < num_extents; ++k) histogram[k] = std::max(histogram[k], other[k]);
    const auto sums = histogram.subspan(num_extents);
    std::ranges::transform(other.subspan(num_extents), sums, sums.begin(), std::plus<>());
}

}  // namespace rrcb
