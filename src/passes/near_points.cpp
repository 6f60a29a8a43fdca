#include "passes/near_points.hpp"

#include "cuts/tree.hpp"
#include "passes/sample.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

int num_near_cuts(const Cuts& cuts, const Vector& position, double reach) {
    int number = 0;
    Descent at = root_of(cuts);
    while (!at.is_part()) {
        const Cut& cut = cuts.tree[at.node];
        if (std::abs(position[cut.axis] - cut.at[cut.axis]) < reach) ++number;
        at = is_above(cut, position, cuts.dimension) ? at.upper() : at.lower();
    }
    return number;
}

}  // namespace

NearShare near_share(const Cuts& cuts, const Points& points, double reach, LocalIndex most) {
    NearShare near;
    if (!(reach > 0) || points.count == 0) return near;
    double weight = 0;
    const LocalIndex size = std::min(most, points.count);
    for (LocalIndex k = 0; k < size; ++k) {
        const LocalIndex i = size < points.count ? sampled(k, points.count) : k;
        const double own = points.weights.empty() ? 1 : points.weights[i];
        const int number = num_near_cuts(cuts, points.position(i), reach);
        near.by_count += number;
        near.by_weight += number * own;
        weight += own;
    }
    near.by_count /= static_cast<double>(size);
    near.by_weight = weight > 0 ? near.by_weight / weight : 0;
    return near;
}

}  // namespace rrcb
