#pragma once

#include <array>
#include <cstddef>

namespace rrcb {

/// Median of the first `count`, three at most; of two the smaller.
double median(const std::array<double, 3>& values, std::size_t count);

/// The latest values of a noisy series.
class LoadWindow {
  public:
    void add(double excess, double mean);
    void clear() { count_ = 0; }
    std::size_t count() const { return count_; }  ///< since cleared

    /// Medians of the last three: an outlier alone does not show. Of two the smaller.
    double excess() const { return median_of_latest(excess_); }
    double mean() const { return median_of_latest(mean_); }

    /// What the median of the series exceeds by now, with some certainty however its noise is
    /// distributed; minus infinity before the third value.
    double lower_bound() const;

    /// What the median of the latest twelve does not exceed, with the same certainty; infinity
    /// before there are twelve.
    double upper_bound() const;

  private:
    static constexpr std::size_t longest = 48;
    using Values = std::array<double, longest>;

    /// Of the latest `length`, the one of `rank` from below.
    double order_statistic(std::size_t length, std::size_t rank) const;
    double median_of_latest(const Values& values) const {
        return median({latest(values, 0), latest(values, 1), latest(values, 2)}, count_);
    }
    double latest(const Values& values, std::size_t ago) const {
        return values[(count_ - 1 - ago) % longest];
    }

    Values excess_{};
    Values mean_{};
    std::size_t count_ = 0;
};

}  // namespace rrcb
