#include "bisection/slice.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

/// Restricts a density to the first fraction `t` of its interval, scaled to the mean 1; uniform if
/// no weight is left.
void restrict_to_first(double t, double& slope, double& bow) {
    const double mean = 1 - (1 - t) * (slope + bow * (2 * t - 1));
    const double least = 1e-12 * (1 + std::abs(slope) + std::abs(bow));
    if (!(mean > least)) {
        slope = bow = 0;
        return;
    }
    slope = t * (slope - 3 * bow * (1 - t)) / mean;
    bow = t * t * bow / mean;
}

}  // namespace

std::pair<Patch, Patch> divide(const Patch& patch, std::size_t axis, double value) {
    Patch below = patch;
    Patch above = patch;
    below.upper[axis] = above.lower[axis] = value;
    below.weight = weight_below(slice_of(patch, axis), value);
    above.weight -= below.weight;
    const double t = fraction_below(patch.lower[axis], value, patch.upper[axis]);
    restrict_to_first(t, below.slope[axis], below.bow[axis]);
    // The upper part is the first of the mirror image.
    above.slope[axis] = -above.slope[axis];
    restrict_to_first(1 - t, above.slope[axis], above.bow[axis]);
    above.slope[axis] = -above.slope[axis];
    return {below, above};
}

}  // namespace rrcb
