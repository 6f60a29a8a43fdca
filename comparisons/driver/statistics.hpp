#pragma once

#include <optional>
#include <span>
#include <vector>

namespace comparisons {

/// From the lower to the upper end.
struct Interval {
    double low = 0;
    double high = 0;
};

/// Middle of the values, the mean of the two middle ones when their number is even; 0 of none.
double median(std::vector<double> values);

/// Holds the median of what the values are drawn from with at least 95 %, whatever its
/// distribution: two order statistics, equally far from both ends.
///
/// The narrowest such pair, by the binomial distribution. None of fewer than 6 values, where even
/// the smallest and the largest hold it with less. At most 16,000 values.
std::optional<Interval> interval95(std::vector<double> values);

/// From the smallest to the largest value; 0 of none.
Interval range_of(std::span<const double> values);

/// values[i] / reference[i], measured in the same turn. Empty when their numbers differ or a
/// reference is not above 0.
std::vector<double> paired_ratios(std::span<const double> values,
                                  std::span<const double> reference);

}  // namespace comparisons
