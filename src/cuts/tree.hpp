#pragma once

#include <rrcb/cuts.hpp>

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

/// Axis of each cut, in preorder.
inline std::vector<int> axes_of(const Cuts& cuts) {
    std::vector<int> axes;
    for (const Cut& cut : cuts.tree) axes.push_back(cut.axis);
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

/// True when a closed box holds the place of points that lie on both sides of a cut.
inline bool holds_divided_points(const Box& box, const Cut& cut, int dimension) {
    if (cut.divides == 0) return false;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
        if (!(box.lower[a] <= cut.at[a] && cut.at[a] <= box.upper[a])) return false;
    return true;
}

}  // namespace rrcb
