#include "cuts/binned_assignment.hpp"

#include "cells/running_sums.hpp"
#include "cells/sorted_points.hpp"
#include "cuts/tree.hpp"

#include <limits>

namespace rrcb {

namespace {

constexpr Part undecided = -1;

/// How to tell the part of a cell's points: by the side of a plane they lie on.
struct Rule {
    double plane = 0;
    std::int32_t axis = 0;
    /// Below the plane, on it, above it.
    std::array<Part, 3> parts{undecided, undecided, undecided};
};

Rule rule_of(const Cuts& cuts, const Box& box) {
    const Descent at = first_crossing(cuts, box, root_of(cuts));
    if (at.is_part()) return {0, 0, {at.first_part, at.first_part, at.first_part}};
    const Cut& cut = cuts.tree[at.node];
    const auto axis = static_cast<std::size_t>(cut.axis);
    Box below = box;
    Box above = box;
    below.upper[axis] = above.lower[axis] = cut.at[axis];
    const Descent lower = first_crossing(cuts, below, at.lower());
    const Descent upper = first_crossing(cuts, above, at.upper());
    Rule rule{cut.at[axis], cut.axis, {}};
    rule.parts[0] = lower.is_part() ? lower.first_part : undecided;
    rule.parts[2] = upper.is_part() ? upper.first_part : undecided;
    rule.parts[1] = is_plane(cut, cuts.dimension) ? rule.parts[2] : undecided;
    return rule;
}

/// What the cuts make of the cells.
struct CellRules {
    std::vector<Part> parts;  ///< of all points of a cell; undecided where they differ
    std::vector<Rule> rules;  ///< where they differ

    CellRules(const Cuts& cuts, const BinnedPoints& binned)
        : parts(binned.counts.size()), rules(binned.counts.size()) {
        for (LocalIndex cell = 0; cell < parts.size(); ++cell) {
            if (binned.counts[cell] == 0) continue;
            const Rule rule = rules[cell] = rule_of(cuts, enclosing_box(binned.mesh, cell));
            const bool same = rule.parts[0] == rule.parts[1] && rule.parts[1] == rule.parts[2];
            parts[cell] = same ? rule.parts[0] : undecided;
        }
    }
};

/// What the points of cells of one part weigh, in each part.
std::vector<double> weights_of_whole_cells(const CellRules& cells, const BinnedPoints& binned,
                                           int num_parts) {
    const bool weighted = !binned.points.weights.empty();
    std::vector<double> weights(static_cast<std::size_t>(num_parts));
    for (LocalIndex cell = 0; cell < cells.parts.size(); ++cell) {
        if (cells.parts[cell] == undecided) continue;
        weights[static_cast<std::size_t>(cells.parts[cell])] +=
            weighted ? binned.weights[cell] / binned.weight_scale
                     : static_cast<double>(binned.counts[cell]);
    }
    return weights;
}

/// Parts of consecutive points by their cells alone; returns how many are left, and which.
std::size_t apply_cells(const BinnedPoints& binned, const CellRules& cells, LocalIndex first,
                        std::span<Part> parts, LocalIndex* left) {
    std::size_t num_left = 0;
    for (LocalIndex i = first; i < first + parts.size(); ++i) {
        const Part part = cells.parts[binned.cells[i]];
        parts[i - first] = part;
        left[num_left] = i;
        num_left += part == undecided;
    }
    return num_left;
}

/// Part of a point by the rule of its cell.
Part part_by_rule(const Cuts& cuts, const Rule& rule, const Points& points, LocalIndex i) {
    const double value = points.coordinate(i, rule.axis);
    const int side = static_cast<int>(value >= rule.plane) + static_cast<int>(value > rule.plane);
    const Part part = rule.parts[static_cast<std::size_t>(side)];
    return part == undecided ? part_of(cuts, points.position(i)) : part;
}

}  // namespace

std::vector<double> assign(const Cuts& cuts, const BinnedPoints& binned, std::span<Part> parts) {
    constexpr LocalIndex block_length = 512;
    const Points& points = binned.points;
    const CellRules cells(cuts, binned);
    std::vector<double> weights = weights_of_whole_cells(cells, binned, cuts.num_parts);
    std::array<LocalIndex, block_length> left;
    in_ranges(points.count, block_length, [&](LocalIndex first, LocalIndex last) {
        const std::size_t num_left =
            apply_cells(binned, cells, first, parts.subspan(first, last - first), left.data());
        for (const LocalIndex i : std::span(left).first(num_left)) {
            parts[i] = part_by_rule(cuts, cells.rules[binned.cells[i]], points, i);
            weights[static_cast<std::size_t>(parts[i])] += points.weight(i);
        }
    });
    return weights;
}

}  // namespace rrcb
