#include "bisection/patches.hpp"

#include "bisection/slice.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

/// Returns the axis that decides the side of a patch: the cut's, or the next one without a tie.
int deciding_axis(const Cut& cut, const Patch& patch, int dimension) {
    const auto tied = [&](int axis) {
        return patch.lower[axis] == cut.at[axis] && patch.upper[axis] == cut.at[axis];
    };
    if (!tied(cut.axis)) return cut.axis;
    for (int axis = 0; axis < dimension; ++axis)
        if (axis != cut.axis && !tied(axis)) return axis;
    return cut.axis;
}

}  // namespace

double weight_of(const StatisticalDomain& domain) {
    double weight = 0;
    for (const Patch& patch : domain.patches) weight += patch.weight;
    return weight;
}

Box extent_of(const StatisticalDomain& domain) {
    Box box;
    for (const Patch& patch : domain.patches) {
        for (std::size_t a = 0; a < max_dimension; ++a) {
            box.lower[a] = std::min(box.lower[a], patch.lower[a]);
            box.upper[a] = std::max(box.upper[a], patch.upper[a]);
        }
    }
    return box;
}

double mean_half_side(const StatisticalDomain& domain) {
    double sum = 0;
    double weight = 0;
    for (const Patch& patch : domain.patches) {
        double sides = 0;
        for (int a = 0; a < domain.dimension; ++a) sides += patch.upper[a] / 2 - patch.lower[a] / 2;
        weight += patch.weight;
        sum += patch.weight * sides;
    }
    return weight > 0 && std::isfinite(sum) ? sum / domain.dimension / weight : 0;
}

Halves split_domain(StatisticalDomain domain, const Cut& cut) {
    const int dimension = domain.dimension;
    StatisticalDomain lower{dimension, {}};
    lower.patches.reserve(domain.patches.size());
    auto upper = domain.patches.begin();  // end of those above, which stay in this memory
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
