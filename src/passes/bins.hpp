#pragma once

#include "cuts/axis_limits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rrcb {

/// Bins of a bracket [lower, upper). Their slots are numbered from 1; slot 0 is below the bracket,
/// slot num_bins + 1 above it.
///
/// Bins have equal width, or contain equal numbers of doubles (`by_bits`), or equal numbers of
/// cells of a grid. Bins with equal numbers of doubles divide points evenly that are spread over
/// hundreds of decades. With a grid, cuts can only be on grid lines.
class Bins {
  public:
    Bins(double lower, double upper, bool by_bits, int num_bins);

    /// Makes bins between two lines of the grid of `limits`.
    Bins(double lower, double upper, const AxisLimits& limits, int num_bins);

    /// Returns edge number k of the num_bins + 1 edges, which ascend from `lower` to `upper`.
    double edge(int k) const {
        if (k == num_bins_) return upper_;
        if (!by_bits_) return std::min(lower_ + k * width_, upper_);
        return edge_by_number(k);
    }

    /// Returns the slot whose rounded edges enclose `value`.
    std::int32_t slot_of(double value) const {
        if (value < lower_) return 0;
        if (!(value < upper_)) return num_bins_ + 1;
        if (!by_bits_) return bin_by_width(value) + 1;
        return slot_by_number(value);
    }

  private:
    std::int32_t bin_by_width(double value) const {
        const double share = std::min((value - lower_) * bins_a_length_, num_bins_ - 0.5);
        int bin = static_cast<int>(share);
        if (std::abs(share - bin - 0.5) < sure_) return bin;
        // Compares with the rounded edges, because cuts are put exactly on these.
        while (bin > 0 && value < edge(bin)) --bin;
        while (bin + 1 < num_bins_ && value >= edge(bin + 1)) ++bin;
        return bin;
    }
    // These are for bins of doubles or cells. They are not inlined, because most bins have equal
    // width and that loop is critical.
    [[gnu::noinline]] double edge_by_number(int k) const;
    [[gnu::noinline]] std::int32_t slot_by_number(double value) const;

    double lower_;
    double upper_;
    int num_bins_;
    bool by_bits_;
    double width_ = 0;          ///< width of a bin
    double bins_a_length_ = 0;  ///< 1 / width_, if that is finite
    double sure_ = 0;           ///< if a value is nearer than this to the middle of a bin, in bins,
                                ///< round-off cannot put it into another bin
    std::int64_t lower_rank_ = 0;    ///< rank of `lower` among all doubles in ascending order
    std::uint64_t num_doubles_ = 0;  ///< number of doubles in the bracket
    std::uint64_t doubles_a_bin_ = 1;
    AxisLimits limits_{};
    double first_line_ = 0;
    double cells_a_bin_ = 0;  ///< 0 without a grid
};

}  // namespace rrcb
