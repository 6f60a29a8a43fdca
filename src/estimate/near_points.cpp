#include "estimate/near_points.hpp"

#include "cuts/tree.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace rrcb {

namespace {

/// Number of cuts near a position, and the end of the tree that it is in.
struct NearCount {
    int number = 0;
    Part end = 0;
};

NearCount count_near(const Cuts& cuts, const Vector& position, double reach) {
    NearCount near;
    Descent at = root_of(cuts);
    while (!at.is_part()) {
        const Cut& cut = cuts.tree[at.node];
        const double beyond = position[cut.axis] - cut.at[cut.axis];
        if (std::abs(beyond) < reach) ++near.number;
        const bool above = beyond == 0 ? is_above(cut, position, cuts.dimension) : beyond > 0;
        at = above ? at.upper() : at.lower();
    }
    near.end = at.first_part;
    return near;
}

}  // namespace

NearShare near_share(const Cuts& cuts, const PointSample& sample, double reach) {
    NearShare near;
    const std::size_t size = sample.positions.size();
    if (!(reach > 0) || size == 0) return near;
    double weight = 0;
    // The last point of some of the parts: enough pairs, and no memory in proportion to the parts.
    std::array<std::pair<Part, const Vector*>, 1024> last{};
    double num_pairs = 0;
    for (std::size_t k = 0; k < size; ++k) {
        const double own = sample.weights.empty() ? 1 : sample.weights[k];
        const Vector& position = sample.positions[k];
        const auto [number, end] = count_near(cuts, position, reach);
        const std::pair<Part, const Vector*> own_end{end, &position};
        const auto [other_end, other] =
            std::exchange(last[static_cast<std::size_t>(end) % last.size()], own_end);
        if (other && other_end == end) {
            ++num_pairs;
            for (std::size_t a = 0; a < max_dimension; ++a)
                near.spread[a] += std::abs(position[a] - (*other)[a]);
        }
        near.by_count += number;
        near.by_weight += number * own;
        weight += own;
    }
    near.by_count /= static_cast<double>(size);
    for (double& spread : near.spread) spread = num_pairs > 0 ? spread / num_pairs : 0;
    near.by_weight = weight > 0 ? near.by_weight / weight : 0;
    return near;
}

}  // namespace rrcb
