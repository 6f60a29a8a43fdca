#include "statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace comparisons {

namespace {

/// Returns the number of values that can be left out at each end of the sorted values.
std::optional<std::size_t> left_out_at_each_end(std::size_t num_values) {
    constexpr long double most_at_one_end = 0.05L / 2;
    // The sum starts with the probability that none of the values is below the median, 2^-n. This
    // needs long double.
    long double probability = std::ldexp(1.0L, -static_cast<int>(num_values));
    long double sum = probability;
    std::optional<std::size_t> left_out;
    for (std::size_t below = 0; sum <= most_at_one_end; ++below) {
        left_out = below;
        probability *= static_cast<long double>(num_values - below);
        probability /= static_cast<long double>(below + 1);
        sum += probability;
    }
    return left_out;
}

}  // namespace

double sum(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

std::optional<Interval> interval95(std::vector<double> values) {
    const std::optional<std::size_t> left_out = left_out_at_each_end(values.size());
    if (!left_out) return std::nullopt;
    std::ranges::sort(values);
    return Interval{values[*left_out], values[values.size() - 1 - *left_out]};
}

Interval range_of(std::span<const double> values) {
    if (values.empty()) return {};
    const auto [low, high] = std::ranges::minmax(values);
    return {low, high};
}

std::vector<double> paired_ratios(std::span<const double> values,
                                  std::span<const double> reference) {
    if (values.size() != reference.size() ||
        std::ranges::any_of(reference, [](double r) { return !(r > 0); })) {
        return {};
    }
    std::vector<double> ratios;
    for (std::size_t i = 0; i < values.size(); ++i) ratios.push_back(values[i] / reference[i]);
    return ratios;
}

}  // namespace comparisons
