#pragma once

#include <array>
#include <cstddef>

namespace rrcb {

/// Sums over some steps, in units of the first mean load.
struct Waste {
    double waste = 0;  ///< of heaviest - mean load
    double work = 0;   ///< of the mean loads

    double excess() const { return work > 0 ? waste / work : 0; }
    /// Writes or reads this, as all of this name.
    void store(auto& state) { state.each(waste, work); }

    friend Waste operator+(const Waste& a, const Waste& b) {
        return {a.waste + b.waste, a.work + b.work};
    }
    friend Waste operator*(double factor, const Waste& a) {
        return {factor * a.waste, factor * a.work};
    }
};

/// Runs of steps have lengths 2^k with k below this: more steps than any program makes.
inline constexpr std::size_t num_lengths = 48;

/// Returns 2^k.
inline double steps_of(std::size_t k) {
    return static_cast<double>(std::size_t{1} << k);
}

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

    void store(auto& state) {
        state.count(num_first_, num_lengths);
        state.each(count_, total_);
        for (std::size_t k = 0; k < num_first_; ++k) state.each(first_[k]);
    }

  private:
    std::size_t num_first_ = 0;  ///< known sums
    std::size_t count_ = 0;
    Waste total_;  ///< of this cycle only
    std::array<Waste, num_lengths> first_{};
};

/// Blocks of the latest steps, three of each length 2^k.
///
/// In the mean of a block, an imbalance of every fifth step counts as much as a fifth of it in each
/// step. One stall raises only one of three blocks.
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

    void store(auto& state) {
        state.count(count_, std::size_t{1} << (num_lengths - 1));
        for (std::size_t k = 0; count_ >> k > 0; ++k)
            for (std::size_t b = 0; b < num_blocks && b < count_ >> k; ++b)
                state.each(blocks_[k][b]);
    }

  private:
    std::size_t count_ = 0;
    std::array<std::array<Waste, num_blocks>, num_lengths> blocks_{};  ///< latest first
};

}  // namespace rrcb
