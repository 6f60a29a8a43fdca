#include "bisection/patches.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

/// Returns the axis that decides on which side of a cut a patch is: the axis of the cut, or the
/// next axis along which the patch is not on the cut.
int deciding_axis(const Cut& cut, const Patch& patch, int dimension) {
    const auto tied = [&](int axis) {
        return patch.lower[axis] == cut.at[axis] && patch.upper[axis] == cut.at[axis];
    };
    if (!tied(cut.axis)) return cut.axis;
    for (int axis = 0; axis < dimension; ++axis)
        if (axis != cut.axis && !tied(axis)) return axis;
    return cut.axis;
}

/// Returns the share of [lower, upper] below `value`, which must be in the interval; `lower` is
/// less than `upper`.
double fraction_below(double lower, double value, double upper) {
    const double extent = upper - lower;
    if (std::isinf(extent)) return (value / 2 - lower / 2) / (upper / 2 - lower / 2);
    return (value - lower) / extent;
}

/// Returns the mean of a density over the first fraction `t` of its interval, relative to its mean
/// over the complete interval.
double mean_of_first(double t, double slope, double bow) {
    return 1 - (1 - t) * (slope + bow * (2 * t - 1));
}

/// Restricts a density to the first fraction `t` of its interval, and scales it to the mean 1. The
/// density becomes uniform if no weight is left.
void restrict_to_first(double t, double& slope, double& bow) {
    const double mean = mean_of_first(t, slope, bow);
    const double least = 1e-12 * (1 + std::abs(slope) + std::abs(bow));
    if (!(mean > least)) {
        slope = bow = 0;
        return;
    }
    slope = t * (slope - 3 * bow * (1 - t)) / mean;
    bow = t * t * bow / mean;
}

/// Cuts a patch at a value between its ends along an axis, and keeps the upper part in `patch`.
/// Returns the lower part. The two weights add up to the old weight.
Patch cut_off_below(Patch& patch, int axis, double value) {
    const double t = fraction_below(patch.lower[axis], value, patch.upper[axis]);
    const double mean = mean_of_first(t, patch.slope[axis], patch.bow[axis]);
    Patch below = patch;
    below.weight = patch.weight * std::clamp(t * mean, 0.0, 1.0);
    below.upper[axis] = patch.lower[axis] = value;
    patch.weight -= below.weight;
    restrict_to_first(t, below.slope[axis], below.bow[axis]);
    // The upper part is computed as the first part of the mirror image.
    patch.slope[axis] = -patch.slope[axis];
    restrict_to_first(1 - t, patch.slope[axis], patch.bow[axis]);
    patch.slope[axis] = -patch.slope[axis];
    return below;
}

}  // namespace

double weight_of(const StatisticalDomain& domain) {
    double weight = 0;
    for (const Patch& patch : domain.patches) weight += patch.weight;
    return weight;
}

Halves split_domain(StatisticalDomain domain, const Cut& cut) {
    const int dimension = domain.dimension;
    StatisticalDomain lower{dimension, {}};
    lower.patches.reserve(domain.patches.size());
    auto upper = domain.patches.begin();  // end of the upper ones, which stay in this memory
    for (Patch& patch : domain.patches) {
        const int axis = deciding_axis(cut, patch, dimension);
        const double value = cut.at[axis];
        if (patch.lower[axis] >= value) {
            *upper++ = patch;
        } else if (patch.upper[axis] <= value) {
            lower.patches.push_back(patch);
        } else {
            lower.patches.push_back(cut_off_below(patch, axis, value));
            *upper++ = patch;
        }
    }
    domain.patches.erase(upper, domain.patches.end());
    return {std::move(lower), std::move(domain)};
}

}  // namespace rrcb
