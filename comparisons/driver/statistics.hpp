#pragma once

#include <optional>
#include <span>
#include <vector>

namespace comparisons {

/// An interval with both ends included.
struct Interval {
    double low = 0;
    double high = 0;
};

/// Returns the sum of the values in their order.
double sum(std::span<const double> values);

/// Returns the median, which is the mean of the two middle values if their number is even. Returns
/// 0 if there are no values.
double median(std::vector<double> values);

/// Returns a confidence interval of at least 95 % for the median of the distribution of the values.
/// It makes no assumption about the distribution. Its ends are two of the values.
///
/// It is the narrowest interval that leaves out equally many values at each end, by the binomial
/// distribution. Returns nullopt for fewer than 6 values, whose full range has less than 95 %
/// confidence. Accepts at most 16,000 values.
std::optional<Interval> interval95(std::vector<double> values);

/// Returns the interval from the smallest to the largest value; 0 to 0 if there are no values.
Interval range_of(std::span<const double> values);

/// Returns values[i] / reference[i] for each turn i. Empty if the numbers of values differ, or if a
/// reference is not above 0.
std::vector<double> paired_ratios(std::span<const double> values,
                                  std::span<const double> reference);

}  // namespace comparisons
