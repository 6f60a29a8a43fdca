#include "passes/bins.hpp"

#include "arithmetic/double_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rrcb {

Bins::Bins(double lower, double upper, bool by_bits, int num_bins)
    : lower_(lower), upper_(upper), num_bins_(num_bins), by_bits_(by_bits) {
    // A bracket that contains the largest double ends at infinity; this keeps its width finite.
    using Limits = std::numeric_limits<double>;
    const double end = std::min(upper, Limits::max());
    width_ = end / num_bins - lower / num_bins;
    if (width_ >= Limits::min()) bins_a_length_ = 1 / width_;
    const double rounded = num_bins + std::max(std::abs(lower), std::abs(end)) * bins_a_length_;
    const bool is_sure = bins_a_length_ > 0 && end / 2 - lower / 2 <= Limits::max() / 2;
    if (is_sure) sure_ = 0.5 - std::ldexp(rounded, -50);
    lower_rank_ = double_rank(lower);
    // Computes modulo 2^64, because the difference of two ranks may overflow a signed integer.
    num_doubles_ =
        static_cast<std::uint64_t>(double_rank(upper)) - static_cast<std::uint64_t>(lower_rank_);
    const auto bins = static_cast<std::uint64_t>(num_bins);
    // If there are so few doubles, rounded edges would coincide.
    by_bits_ = by_bits_ || num_doubles_ < bins * bins;
    doubles_a_bin_ = std::max<std::uint64_t>(1, num_doubles_ / bins + (num_doubles_ % bins != 0));
}

Bins::Bins(double lower, double upper, const AxisLimits& limits, int num_bins)
    : lower_(lower),
      upper_(upper),
      num_bins_(num_bins),
      by_bits_(true),
      limits_(limits),
      first_line_(limits.line_below(lower)) {
    const double num_cells = limits.line_below(upper) - first_line_;
    cells_a_bin_ = std::max(1.0, std::ceil(num_cells / num_bins));
}

double Bins::edge_by_number(int k) const {
    if (cells_a_bin_ > 0) return std::min(limits_.line(first_line_ + k * cells_a_bin_), upper_);
    const auto bins = static_cast<std::uint64_t>(k);
    if (bins > num_doubles_ / doubles_a_bin_) return upper_;
    return double_of_rank(
        static_cast<std::int64_t>(static_cast<std::uint64_t>(lower_rank_) + bins * doubles_a_bin_));
}

std::int32_t Bins::slot_by_number(double value) const {
    if (cells_a_bin_ > 0) {
        const double cells = limits_.line_below(value) - first_line_;
        return static_cast<std::int32_t>(std::floor(cells / cells_a_bin_)) + 1;
    }
    const std::uint64_t offset =
        static_cast<std::uint64_t>(double_rank(value)) - static_cast<std::uint64_t>(lower_rank_);
    return static_cast<std::int32_t>(offset / doubles_a_bin_) + 1;
}

}  // namespace rrcb
