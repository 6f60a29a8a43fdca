#include "binned_assignment.hpp"

#include "descent.hpp"
#include "lane_sums.hpp"
#include "point_layout.hpp"
#include "sides.hpp"

#include <rrcb/sorted_points.hpp>

#include <limits>

namespace rrcb {

namespace {

constexpr Part look_up = -1;

/// How to tell the part of a cell's points: by the side of a plane they lie on.
struct Rule {
    double plane = 0;
    std::int32_t axis = 0;
    std::array<Part, 3> parts{look_up, look_up, look_up};  ///< below the plane, on it, above it
};

/// The node where the cuts first part a box, or the part that holds all of it.
Descent first_crossing(const Cuts& cuts, const Box& box, Descent at) {
    while (!at.is_part()) {
        const Sides sides = sides_of(box, cuts.tree[at.node], cuts.dimension);
        if (sides.below && sides.above) break;
        at = sides.above ? at.upper() : at.lower();
    }
    return at;
}

bool is_plane(const Cut& cut, int dimension) {
    for (int a = 0; a < dimension; ++a)
        if (a != cut.axis &&
            cut.at[static_cast<std::size_t>(a)] != -std::numeric_limits<double>::infinity())
            return false;
    return true;
}

Rule rule_of(const Cuts& cuts, const Box& box) {
    const Descent at = first_crossing(cuts, box, root_of(cuts));
    if (at.is_part()) return {0, 0, {at.first, at.first, at.first}};
    const Cut& cut = cuts.tree[at.node];
    const auto axis = static_cast<std::size_t>(cut.axis);
    Box below = box;
    Box above = box;
    below.upper[axis] = above.lower[axis] = cut.at[axis];
    const Descent lower = first_crossing(cuts, below, at.lower());
    const Descent upper = first_crossing(cuts, above, at.upper());
    Rule rule{cut.at[axis], cut.axis, {}};
    rule.parts[0] = lower.is_part() ? lower.first : look_up;
    rule.parts[2] = upper.is_part() ? upper.first : look_up;
    rule.parts[1] = is_plane(cut, cuts.dimension) ? rule.parts[2] : look_up;
    return rule;
}

std::vector<Rule> rules_of(const Cuts& cuts, const BinnedPoints& binned) {
    std::vector<Rule> rules(binned.counts.size());
    for (LocalIndex cell = 0; cell < rules.size(); ++cell)
        if (binned.counts[cell] > 0) rules[cell] = rule_of(cuts, enclosing_box(binned.mesh, cell));
    return rules;
}

/// Parts of consecutive points by the rules; returns how many need a look-up, and which.
template <class Layout>
std::size_t apply_rules(const Layout& x, const BinnedPoints& binned, const std::vector<Rule>& rules,
                        std::pair<LocalIndex, LocalIndex> range, std::span<Part> parts,
                        LocalIndex* left) {
    std::size_t num_left = 0;
    for (LocalIndex i = range.first; i < range.second; ++i) {
        const Rule& rule = rules[binned.cells[i]];
        const double value = x(i, rule.axis);
        const int side = static_cast<int>(value >= rule.plane) + (value > rule.plane ? 1 : 0);
        parts[i] = rule.parts[static_cast<std::size_t>(side)];
        left[num_left] = i;
        num_left += parts[i] == look_up;
    }
    return num_left;
}

}  // namespace

std::vector<double> assign(const Cuts& cuts, const BinnedPoints& binned, std::span<Part> parts) {
    constexpr LocalIndex block_length = 512;
    const Points& points = binned.points;
    const std::vector<Rule> rules = rules_of(cuts, binned);
    LaneSums<double> weights(static_cast<std::size_t>(cuts.num_parts));
    std::array<LocalIndex, block_length> left;
    visit_layout(points, [&](const auto& x) {
        in_ranges(points.count, block_length, [&](LocalIndex first, LocalIndex last) {
            const std::size_t num_left =
                apply_rules(x, binned, rules, {first, last}, parts, left.data());
            for (const LocalIndex i : std::span(left).first(num_left))
                parts[i] = part_of(cuts, points.position(i));
            for (LocalIndex i = first; i < last; ++i)
                weights.of(static_cast<std::size_t>(parts[i]), i) += points.weight(i);
        });
    });
    weights.empty_lanes();
    return weights.totals();
}

}  // namespace rrcb
