#include "cells/point_layout.hpp"
#include "cuts/tree.hpp"

#include <rrcb/cuts.hpp>

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The tree as a table for the loop over points: child 0 is below the plane, child 1 above. Parts
/// are nodes that lead to themselves, so that every point takes the same number of steps.
struct Table {
    struct Node {
        double plane = infinity;
        std::int32_t axis = 0;
        std::array<std::int32_t, 2> child{};
        Part part = 0;
    };
    std::vector<Node> nodes;
    int depth = 0;
    bool plain = true;  ///< every cut is a plane, none breaks ties by position
};

std::int32_t tabulate(const Cuts& cuts, Descent at, int depth, Table& table) {
    const auto index = static_cast<std::int32_t>(table.nodes.size());
    table.nodes.emplace_back();
    table.depth = std::max(table.depth, depth);
    if (at.is_part()) {
        table.nodes.back() = {infinity, 0, {index, index}, at.first_part};
        return index;
    }
    const Cut& cut = cuts.tree[at.node];
    table.plain = table.plain && is_plane(cut, cuts.dimension);
    const std::int32_t below = tabulate(cuts, at.lower(), depth + 1, table);
    const std::int32_t above = tabulate(cuts, at.upper(), depth + 1, table);
    table.nodes[static_cast<std::size_t>(index)] = {
        cut.at[static_cast<std::size_t>(cut.axis)], cut.axis, {below, above}, 0};
    return index;
}

template <class Layout>
void assign_by_planes(const Layout& x, const Table& table, std::span<Part> parts) {
    const Table::Node* nodes = table.nodes.data();
    for (LocalIndex i = 0; i < parts.size(); ++i) {
        std::int32_t node = 0;
        for (int level = 0; level < table.depth; ++level)
            node = nodes[node].child[x(i, nodes[node].axis) >= nodes[node].plane];
        parts[i] = nodes[node].part;
    }
}

void collect_touching(const Cuts& cuts, const Box& box, Descent at, std::vector<Part>& parts) {
    if (at.is_part()) {
        parts.push_back(at.first_part);
        return;
    }
    const Cut& cut = cuts.tree[at.node];
    const Sides sides = sides_of(box, cut, cuts.dimension);
    if (sides.below || holds_divided_points(box, cut, cuts.dimension))
        collect_touching(cuts, box, at.lower(), parts);
    if (sides.above) collect_touching(cuts, box, at.upper(), parts);
}

}  // namespace

bool is_plane(const Cut& cut, int dimension) {
    for (int a = 0; a < dimension; ++a)
        if (a != cut.axis && cut.at[static_cast<std::size_t>(a)] != -infinity) return false;
    return true;
}

bool is_above(const Cut& cut, const Vector& position, int dimension) {
    const auto axis = static_cast<std::size_t>(cut.axis);
    if (position[axis] != cut.at[axis]) return position[axis] > cut.at[axis];
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
        if (a != axis && position[a] != cut.at[a]) return position[a] > cut.at[a];
    return true;
}

Part part_of(const Cuts& cuts, const Vector& position) {
    Descent at = root_of(cuts);
    while (!at.is_part())
        at = is_above(cuts.tree[at.node], position, cuts.dimension) ? at.upper() : at.lower();
    return at.first_part;
}

void assign(const Cuts& cuts, const Points& points, std::span<Part> parts) {
    if (points.count == 0) return;
    Table table;
    tabulate(cuts, root_of(cuts), 0, table);
    if (!table.plain) {
        for (LocalIndex i = 0; i < points.count; ++i) parts[i] = part_of(cuts, points.position(i));
        return;
    }
    visit_layout(points,
                 [&](const auto& x) { assign_by_planes(x, table, parts.first(points.count)); });
}

Box box_of(const Cuts& cuts, Part part) {
    Box box;
    box.lower.fill(-infinity);
    box.upper.fill(infinity);
    Descent at = root_of(cuts);
    while (!at.is_part()) {
        const Cut& cut = cuts.tree[at.node];
        const auto axis = static_cast<std::size_t>(cut.axis);
        const bool above = part >= at.upper().first_part;
        if (above) box.lower[axis] = std::max(box.lower[axis], cut.at[axis]);
        if (!above) box.upper[axis] = std::min(box.upper[axis], cut.at[axis]);
        at = above ? at.upper() : at.lower();
    }
    return box;
}

std::vector<Part> parts_touching(const Cuts& cuts, const Box& box) {
    std::vector<Part> parts;
    for (std::size_t a = 0; a < static_cast<std::size_t>(cuts.dimension); ++a)
        if (!(box.lower[a] <= box.upper[a])) return parts;
    collect_touching(cuts, box, root_of(cuts), parts);
    return parts;
}

}  // namespace rrcb
