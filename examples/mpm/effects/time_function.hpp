#pragma once

#include <mpm/parameters.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace mpm {

/// A number that follows straight lines between given times, and stays before and after them.
class TimeFunction {
  public:
    /// Throws std::invalid_argument for another number of values than of times, and for times that
    /// do not ascend. `place` and the names of both are for the error.
    TimeFunction(std::vector<double> times, std::vector<double> values, const std::string& place)
        : times_(std::move(times)), values_(std::move(values)) {
        if (times_.size() != values_.size())
            throw std::invalid_argument(place + " must have a value for each of the 'times'");
        if (!std::ranges::is_sorted(times_, std::less_equal<>{}))
            throw std::invalid_argument(place + " must have 'times' that ascend");
        for (std::size_t k = 1; k < times_.size(); ++k)
            sums_.push_back(sums_.back() +
                            0.5 * (times_[k] - times_[k - 1]) * (values_[k] + values_[k - 1]));
        const double before_start = integral(0);
        for (double& sum : sums_) sum -= before_start;
    }

    double at(double time) const {
        const std::size_t next = next_of(time);
        if (next == 0) return values_.front();
        if (next == times_.size()) return values_.back();
        const double share = (time - times_[next - 1]) / (times_[next] - times_[next - 1]);
        return std::lerp(values_[next - 1], values_[next], share);
    }

    /// Integral from time 0 on.
    double integral(double time) const {
        const std::size_t next = next_of(time);
        const std::size_t last = next == 0 ? 0 : next - 1;
        return sums_[last] + 0.5 * (time - times_[last]) * (values_[last] + at(time));
    }

  private:
    /// Number of the first time after `time`.
    std::size_t next_of(double time) const {
        return static_cast<std::size_t>(std::ranges::upper_bound(times_, time) - times_.begin());
    }

    std::vector<double> times_, values_;
    std::vector<double> sums_{0};  ///< integral from time 0 up to each time
};

}  // namespace mpm
