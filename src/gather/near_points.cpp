#include "gather/near_points.hpp"

#include "cuts/tree.hpp"

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

NearShare near_share(const Cuts& cuts, PointPasses& points, double reach, LocalIndex most) {
    NearShare near;
    if (!(reach > 0) || points.count() == 0) return near;
    double weight = 0;
    const PointSample sample = points.sample(most);
    const std::size_t size = sample.positions.size();
    for (std::size_t k = 0; k < size; ++k) {
        const double own = sample.weights.empty() ? 1 : sample.weights[k];
        const int number = num_near_cuts(cuts, sample.positions[k], reach);
        near.by_count += number;
        near.by_weight += number * own;
        weight += own;
    }
    near.by_count /= static_cast<double>(size);
    near.by_weight = weight > 0 ? near.by_weight / weight : 0;
    return near;
}

}  // namespace rrcb
