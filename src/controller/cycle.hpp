#pragma once

#include "controller/waste.hpp"

#include <array>
#include <cstddef>

namespace rrcb {

/// Course of the waste after a rebalance: sums over the first 1, 2, 4, ... steps, of one cycle or
/// an average of several.
class Cycle {
  public:
    void add(const Waste& step);

    /// Averages with a later cycle, which counts as much as all earlier ones. Beyond its end the
    /// later cycle is continued with its last excess.
    void remember(const Cycle& later, double excess_at_end);

    std::size_t count() const { return count_; }
    const Waste& total() const { return total_; }
    const Waste& first(std::size_t k) const { return first_[k]; }  ///< of 2^k steps

    /// Returns the gain, in steps, of a rebalance followed by this course, over an `excess` that
    /// stays for at most `horizon` steps: the largest for any end of the cycle.
    double gain(double excess, double horizon) const;

    /// Returns the least mean excess of the first 4, 8, ... steps; infinity if there are fewer.
    double least_excess() const;

  private:
    std::size_t num_first_ = 0;  ///< sums that are known
    std::size_t count_ = 0;
    Waste total_;  ///< of this cycle only
    std::array<Waste, num_lengths> first_{};
};

}  // namespace rrcb
