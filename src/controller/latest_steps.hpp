#pragma once

#include "controller/waste.hpp"

#include <array>
#include <cstddef>

namespace rrcb {

/// Blocks of the latest steps, three of each length 2^k.
///
/// A mean over a block takes every step as it was measured, so an imbalance of every fifth step
/// counts as much as a fifth of it in each. Of three blocks in a row, one stall raises only one.
class LatestSteps {
  public:
    static constexpr std::size_t num_blocks = 3;

    void add(const Waste& step);
    std::size_t count() const { return count_; }

    /// Returns whether there are three blocks of length 2^k.
    bool has(std::size_t k) const { return k < num_lengths && count_ >> k >= num_blocks; }

    /// Returns the excess that all of these blocks reach: the least of their mean excesses.
    double lasting(std::size_t k) const;

    /// Returns the greatest of lasting() over all lengths; 0 if there are less than three steps.
    double lasting() const;

    /// Returns the latest complete block of length 2^k.
    const Waste& block(std::size_t k) const { return blocks_[k][0]; }

  private:
    std::size_t count_ = 0;
    std::array<std::array<Waste, num_blocks>, num_lengths> blocks_{};  ///< latest first
};

}  // namespace rrcb
