#pragma once

#include <rrcb/method/statistical_domain.hpp>

#include <algorithm>
#include <cmath>

namespace rrcb {

/// The weight of a patch along one axis, see Patch.
struct Slice {
    double lower = 0;
    double upper = 0;
    double weight = 0;
    double slope = 0;
    double bow = 0;

    bool is_jump() const { return lower == upper; }
};

inline Slice slice_of(const Patch& patch, std::size_t axis) {
    return {patch.lower[axis], patch.upper[axis], patch.weight, patch.slope[axis], patch.bow[axis]};
}

/// Returns the share of [lower, upper] below `value`, which must be inside; lower < upper.
inline double fraction_below(double lower, double value, double upper) {
    const double extent = upper - lower;
    if (std::isinf(extent)) return (value / 2 - lower / 2) / (upper / 2 - lower / 2);
    return (value - lower) / extent;
}

/// Returns the weight below `value`, which may be outside the slice.
inline double weight_below(const Slice& slice, double value) {
    if (slice.upper < value || (slice.upper == value && !slice.is_jump())) return slice.weight;
    if (slice.lower >= value) return 0;
    const double t = fraction_below(slice.lower, value, slice.upper);
    const double mean = 1 - (1 - t) * (slice.slope + slice.bow * (2 * t - 1));
    return slice.weight * std::clamp(t * mean, 0.0, 1.0);
}

/// Takes the part of a patch below a value between its ends along an axis; the weights add up.
/// Returns that part.
Patch cut_off_below(Patch& patch, std::size_t axis, double value);

}  // namespace rrcb
