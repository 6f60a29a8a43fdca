#pragma once

#include <cstdint>

namespace rrcb {

/// Bins of a bracket [lower, upper), numbered from 1; slot 0 is below the bracket, slot
/// num_bins + 1 above it.
///
/// Of equal width; or, `by_bits`, of equal numbers of doubles, which divides a cloud over hundreds
/// of decades as evenly as others.
class Bins {
  public:
    Bins(double lower, double upper, bool by_bits, int num_bins);

    /// Edge number k of the num_bins + 1 edges, ascending from lower to upper.
    double edge(int k) const;

    /// The slot whose edges hold `value`, to the bit.
    std::int32_t slot_of(double value) const;

  private:
    std::int32_t bin_by_width(double value) const;

    double lower_;
    double upper_;
    int num_bins_;
    bool by_bits_;
    double width_;               ///< of a bin
    std::int64_t lower_rank_;    ///< of `lower` in the order of all doubles
    std::uint64_t num_doubles_;  ///< in the bracket
    std::uint64_t doubles_a_bin_;
};

}  // namespace rrcb
