#include "estimate/earlier_cuts.hpp"

#include "arithmetic/infinity.hpp"
#include "bisection/bisection.hpp"
#include "cuts/tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace rrcb {

namespace {

void bracket_node(const Cuts& cuts, const Descent& at, Box box, int depth,
                  std::vector<Bracket>& brackets) {
    if (at.is_part()) return;
    const Cut& cut = cuts.tree[at.node];
    const int axis = cut.axis;
    const double value = std::clamp(cut.at[axis], box.lower[axis], box.upper[axis]);
    const double margin = expected_error(depth);
    brackets.push_back({std::lerp(value, box.lower[axis], 2 * margin),
                        std::nextafter(std::lerp(value, box.upper[axis], 2 * margin), infinity)});
    Box below = box;
    below.upper[axis] = value;
    bracket_node(cuts, at.lower(), below, depth + 1, brackets);
    box.lower[axis] = value;
    bracket_node(cuts, at.upper(), box, depth + 1, brackets);
}

/// Leaves nothing in parts of size 0, and makes the cut a plane if the options ask for planes.
void fit(const Options& options, const Descent& at, Cut& cut) {
    const int axis = cut.axis;
    double value = cut.at[axis];
    if (!options.part_sizes.empty()) {
        const std::span sizes(options.part_sizes);
        const double share =
            share_below(sizes.subspan(at.first_part, at.num_parts), at.lower_parts());
        if (share <= 0) value = -infinity;
        if (share >= 1) value = infinity;
    }
    if (options.axes.plain || value != cut.at[axis]) cut.at.fill(-infinity);
    cut.divides = 0;
    cut.at[axis] = value;
}

/// Number of cuts near a position, and its end of the tree.
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

Cuts fitted(Cuts cuts, const Options& options) {
    for (std::size_t k = 0; k < cuts.tree.size(); ++k) fit(options, node_at(cuts, k), cuts.tree[k]);
    return cuts;
}

void bracket_earlier(const Cuts& cuts, const Box& box, std::vector<Bracket>& brackets) {
    if (box.lower[0] <= box.upper[0]) bracket_node(cuts, root_of(cuts), box, 0, brackets);
}

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
