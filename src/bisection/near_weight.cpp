#include "bisection/near_weight.hpp"

#include "bisection/patches.hpp"
#include "bisection/slice.hpp"

#include <cmath>

namespace rrcb {

double mean_half_side(const StatisticalDomain& domain) {
    double sum = 0;
    double weight = 0;
    for (const Patch& patch : domain.patches) {
        weight += patch.weight;
        for (int a = 0; a < domain.dimension; ++a)
            sum += patch.weight * (patch.upper[a] / 2 - patch.lower[a] / 2) / domain.dimension;
    }
    return weight > 0 && std::isfinite(sum) ? sum / weight : 0;
}

double weight_within(const StatisticalDomain& domain, const Cut& plane, double reach) {
    const double at = plane.at[plane.axis];
    double weight = 0;
    for (const Patch& patch : domain.patches) {
        const Slice slice = slice_of(patch, static_cast<std::size_t>(plane.axis));
        weight += weight_below(slice, at + reach) - weight_below(slice, at - reach);
    }
    return weight;
}

double NearWeight::operator()(const Cut& cut) const {
    const int axis = cut.axis;
    const double at = cut.at[axis];
    const double half_extent = extent_.upper[axis] / 2 - extent_.lower[axis] / 2;
    if (!std::isfinite(at)) return weight_of(domain_);
    if (!(reach_ > 0)) return weight_of(domain_) / half_extent;
    return weight_within(domain_, cut, reach_);
}

}  // namespace rrcb
