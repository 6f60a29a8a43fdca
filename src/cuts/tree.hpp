#pragma once

#include <rrcb/cuts.hpp>

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace rrcb {

/// A node on the way down the tree: its place in the preorder and the parts below it.
struct Descent {
    std::size_t node = 0;
    Part first_part = 0;
    int num_parts = 1;

    bool is_part() const { return num_parts == 1; }
    Descent lower() const { return {node + 1, first_part, lower_parts(num_parts)}; }
    Descent upper() const {
        const int below = lower_parts(num_parts);
        return {node + static_cast<std::size_t>(below), first_part + below, num_parts - below};
    }
};

inline Descent root_of(const Cuts& cuts) {
    return {0, 0, cuts.num_parts};
}

/// The cut of a node; null where the tree is not whole and does not hold it.
inline const Cut* find_cut(const Cuts& cuts, std::size_t node) {
    if (is_whole(cuts)) return &cuts.tree[node];
    const auto found = std::ranges::lower_bound(cuts.nodes, static_cast<std::int32_t>(node));
    if (found == cuts.nodes.end() || *found != static_cast<std::int32_t>(node)) return nullptr;
    return &cuts.tree[static_cast<std::size_t>(found - cuts.nodes.begin())];
}

/// The part of a position at or below `at`, or the first node on the way to it that is not known.
Descent descend(const Cuts& cuts, const Vector& position, Descent at);

/// The node of this number in preorder.
Descent node_at(const Cuts& cuts, std::size_t node);

/// Number of nodes above it.
int depth_of(const Cuts& cuts, std::size_t node);

/// True when all cuts above a part are known.
bool knows_path(const Cuts& cuts, Part part);

/// Throws the Error of a look-up that needs a cut which is not known.
[[noreturn]] void reject_unknown();

/// True when a cut is a plane, which breaks no ties by position.
bool is_plane(const Cut& cut, int dimension);

/// Sides of a cut that a box reaches; both only when the cut crosses it.
struct Sides {
    bool below;
    bool above;
};

inline Sides sides_of(const Box& box, const Cut& cut, int dimension) {
    return {!is_above(cut, box.lower, dimension), is_above(cut, box.upper, dimension)};
}

/// Axis of each cut of a whole tree, in preorder.
inline std::vector<int> axes_of(std::span<const Cut> tree) {
    std::vector<int> axes;
    for (const Cut& cut : tree) axes.push_back(cut.axis);
    return axes;
}

/// The node at or below `at` where the cuts first part a box, or the part that holds all of it.
inline Descent first_crossing(const Cuts& cuts, const Box& box, Descent at) {
    while (!at.is_part()) {
        const Sides sides = sides_of(box, cuts.tree[at.node], cuts.dimension);
        if (sides.below && sides.above) break;
        at = sides.above ? at.upper() : at.lower();
    }
    return at;
}

/// Least box between the cuts above a part at or below `at`, each of which cut_of(node) gives; its
/// bounds may be in reverse, as box_of() has none.
template <class CutOf>
Box region_below(Descent at, Part part, CutOf&& cut_of) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Box box;
    box.lower.fill(-infinity);
    box.upper.fill(infinity);
    while (!at.is_part()) {
        const Cut& cut = cut_of(at);
        const auto axis = static_cast<std::size_t>(cut.axis);
        const bool above = part >= at.upper().first_part;
        if (above) box.lower[axis] = std::max(box.lower[axis], cut.at[axis]);
        if (!above) box.upper[axis] = std::min(box.upper[axis], cut.at[axis]);
        at = above ? at.upper() : at.lower();
    }
    return box;
}

/// True when the cuts above a part, all of which are known, leave no position to its region along
/// some axis, nor points that a cut divides.
bool is_region_empty(const Cuts& cuts, Part part);

/// The parts of which this holds, ascending; of a part of a tree those whose cuts are known.
std::vector<Part> empty_parts(const Cuts& cuts);

/// True when a closed box holds the place of points that lie on both sides of a cut.
inline bool holds_divided_points(const Box& box, const Cut& cut, int dimension) {
    if (cut.divides == 0) return false;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
        if (!(box.lower[a] <= cut.at[a] && cut.at[a] <= box.upper[a])) return false;
    return true;
}

/// Calls visit(part) for the parts at or below `at` that a box touches, see parts_touching().
template <class CutOf, class Visit>
void visit_touching(const Descent& at, const Box& box, int dimension, CutOf&& cut_of,
                    Visit&& visit) {
    if (at.is_part()) return visit(at.first_part);
    const Cut& cut = cut_of(at);
    const Sides sides = sides_of(box, cut, dimension);
    if (sides.below || holds_divided_points(box, cut, dimension))
        visit_touching(at.lower(), box, dimension, cut_of, visit);
    if (sides.above) visit_touching(at.upper(), box, dimension, cut_of, visit);
}

}  // namespace rrcb
