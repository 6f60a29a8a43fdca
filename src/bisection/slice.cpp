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

Patch cut_off_below(Patch& patch, std::size_t axis, double value) {
    const double t = fraction_below(patch.lower[axis], value, patch.upper[axis]);
    Patch below = patch;
    below.weight = weight_below(slice_of(patch, axis), value);
    below.upper[axis] = patch.lower[axis] = value;
    patch.weight -= below.weight;
    restrict_to_first(t, below.slope[axis], below.bow[axis]);
    // The upper part is the first of the mirror image.
    patch.slope[axis] = -patch.slope[axis];
    restrict_to_first(1 - t, patch.slope[axis], patch.bow[axis]);
    patch.slope[axis] = -patch.slope[axis];
    return below;
}

}  // namespace rrcb
