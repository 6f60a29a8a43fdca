#include "refinement/histogram.hpp"

#include "refinement/sample.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace rrcb {

namespace {

constexpr std::size_t status = HistogramLayout::status;
constexpr std::size_t num_extents = HistogramLayout::num_extents;

/// Dimension of the sample in a histogram; 0 where there is none.
int dimension_of_sample(std::span<const double> histogram) {
    return static_cast<int>(histogram[status]) / 2;
}

}  // namespace

void clear_histogram(std::span<double> histogram) {
    std::ranges::fill(histogram, 0.0);
    std::ranges::fill(histogram.first(status), -std::numeric_limits<double>::infinity());
}

std::span<double> clear_to_sample(int dimension, std::span<double> histogram) {
    clear_histogram(histogram);
    histogram[status] = 2.0 * dimension;
    const std::span<double> sample = histogram.subspan(num_extents);
    clear_sample(sample);
    return sample;
}

bool is_marked_failed(std::span<const double> histogram) {
    return static_cast<int>(histogram[status]) % 2 != 0;
}

void join_histograms(std::span<const double> other, std::span<double> histogram) {
    const int dimension = dimension_of_sample(histogram);
    for (std::size_t k = 0; k < num_extents; ++k) histogram[k] = std::max(histogram[k], other[k]);
    const auto from = other.subspan(num_extents);
    const auto to = histogram.subspan(num_extents);
    if (dimension > 0) {
        join_samples(from, dimension, to);
    } else {
        std::ranges::transform(from, to, to.begin(), std::plus<>());
    }
}

}  // namespace rrcb
