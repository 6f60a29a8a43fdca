#include "search/histogram.hpp"

#include "search/sample.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace rrcb {

namespace {

constexpr std::size_t sample_dimension = HistogramLayout::sample_dimension;
constexpr std::size_t num_extents = HistogramLayout::num_extents;

}  // namespace

void clear_histogram(std::span<double> histogram) {
    std::ranges::fill(histogram, 0.0);
    std::ranges::fill(histogram.first(sample_dimension), -std::numeric_limits<double>::infinity());
}

std::span<double> clear_to_sample(int dimension, std::span<double> histogram) {
    clear_histogram(histogram);
    histogram[sample_dimension] = dimension;
    const std::span<double> sample = histogram.subspan(num_extents);
    clear_sample(sample);
    return sample;
}

void join_histograms(std::span<const double> other, std::span<double> histogram) {
    const auto dimension = static_cast<int>(histogram[sample_dimension]);
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
