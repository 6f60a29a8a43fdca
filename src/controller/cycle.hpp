#pragma once

#include <array>
#include <cstddef>

namespace rrcb {

/// Sums over some steps, in units of the first mean load.
struct Waste {
    double waste = 0;  ///< sum of (heaviest - mean load)
    double work = 0;   ///< sum of the mean loads

    double excess() const { return work > 0 ? waste / work : 0; }
    /// Writes or reads all members.
    void store(auto& state) { state.each(waste, work); }

    friend Waste operator+(const Waste& a, const Waste& b) {
        return {a.waste + b.waste, a.work + b.work};
    }
    friend Waste operator*(double factor, const Waste& a) {
        return {factor * a.waste, factor * a.work};
    }
};

/// Sums are kept for runs of 2^k steps with k below this number, which is more steps than any
/// program makes.
inline constexpr std::size_t num_lengths = 48;

/// Returns 2^k.
inline double steps_of(std::size_t k) {
    return static_cast<double>(std::size_t{1} << k);
}

/// Course of the waste after a rebalance: sums over the first 1, 2, 4, ... steps, of one cycle or
/// averaged over several.
class Cycle {
  public:
    void add(const Waste& step);

    /// Averages with a later cycle, which gets the same weight as all earlier ones together. If the
    /// later cycle is shorter, it is continued with its last excess.
    void remember(const Cycle& later, double excess_at_end);

    std::size_t count() const { return count_; }
    const Waste& total() const { return total_; }
    /// sums over the first 2^k steps
    const Waste& first(std::size_t k) const { return first_[k]; }

    /// Returns the gain, in steps, of a rebalance after which the waste follows this course,
    /// compared with keeping `excess` for at most `horizon` steps. Takes the largest gain over all
    /// possible ends of the cycle.
    double gain(double excess, double horizon) const;

    /// Returns the least mean excess of the first 4, 8, ... steps; infinity if there are fewer than
    /// 4.
    double least_excess() const;

    void store(auto& state) {
        state.count(num_first_, num_lengths);
        state.each(count_, total_);
        for (std::size_t k = 0; k < num_first_; ++k) state.each(first_[k]);
    }

  private:
    std::size_t num_first_ = 0;  ///< number of lengths whose sums are known
    std::size_t count_ = 0;
    Waste total_;  ///< sums over all steps of this cycle
    std::array<Waste, num_lengths> first_{};
};

/// Sums over blocks of the latest steps: three blocks of each length 2^k.
///
/// Averaging over a block makes an imbalance in every fifth step count as much as a fifth of it in
/// every step. A single stall raises only one of the three blocks.
class LatestSteps {
  public:
    static constexpr std::size_t num_blocks = 3;

    void add(const Waste& step);
    std::size_t count() const { return count_; }

    /// Returns whether there are three blocks of length 2^k.
    bool has(std::size_t k) const { return k < num_lengths && count_ >> k >= num_blocks; }

    /// Returns the excess that all three blocks of length 2^k have at least.
    double lasting(std::size_t k) const;

    /// Returns the largest lasting(k) over all lengths; 0 if there have been fewer than three
    /// steps.
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
