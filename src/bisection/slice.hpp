#pragma once

#include <rrcb/statistical_domain.hpp>

#include <utility>

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

/// Share of [lower, upper] that lies below `value`, which must be inside; lower < upper.
double fraction_below(double lower, double value, double upper);

/// Weight below `value`, which may lie outside: none to all of it.
double weight_below(const Slice& slice, double value);

/// Cuts a patch in two at a value between its ends along an axis; the weights add up.
std::pair<Patch, Patch> divide(const Patch& patch, std::size_t axis, double value);

}  // namespace rrcb
