#pragma once

#include <rrcb/cuts.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace rrcb {

/// A node on the way down the tree: its number in preorder, and the parts below it.
struct Descent {
    std::size_t node = 0;
    Part first_part = 0;
    int num_parts = 1;
    TreeShape shape{};

    bool is_part() const { return num_parts == 1; }
    int lower_parts() const { return shape.lower_parts(num_parts); }
    Descent lower() const { return {node + 1, first_part, lower_parts(), shape}; }
    Descent upper() const {
        const int below = lower_parts();
        return {node + static_cast<std::size_t>(below), first_part + below, num_parts - below,
                shape};
    }
    bool is_above(Part part) const { return part >= first_part + lower_parts(); }
    Descent towards(Part part) const { return is_above(part) ? upper() : lower(); }
};

inline Descent root_of(int num_parts, const TreeShape& shape) {
    return {0, 0, num_parts, shape};
}
inline Descent root_of(const Cuts& cuts) {
    return root_of(cuts.num_parts, cuts.shape);
}

/// Returns the end of the tree that has a part.
Part end_of(const Cuts& cuts, Part part);

/// Returns the part at each end of the tree.
std::vector<Part> numbers_of(const Cuts& cuts);

/// Replaces ends of the tree by their parts.
void number_parts(const Cuts& cuts, std::span<Part> ends);

/// Returns the number of levels of cuts above the parts of a node.
int num_levels(const TreeShape& shape, int num_parts);

/// Returns the end of the tree, at or below `at`, that contains a position.
inline Descent descend(const Cuts& cuts, const Vector& position, Descent at) {
    while (!at.is_part())
        at = is_above(cuts.tree[at.node], position, cuts.dimension) ? at.upper() : at.lower();
    return at;
}

/// Returns the node with this number in preorder.
Descent node_at(const Cuts& cuts, std::size_t node);

/// Returns a cut that puts all points on the plane above it, without breaking ties.
Cut plane(int axis, double value);

/// Returns true if the other coordinates of points on a cut do not decide about their side.
bool is_plane(const Cut& cut, int dimension);

/// Sides of a cut that a box reaches; both only if the cut crosses the box.
struct Sides {
    bool below;
    bool above;
};

inline Sides sides_of(const Box& box, const Cut& cut, int dimension) {
    return {!is_above(cut, box.lower, dimension), is_above(cut, box.upper, dimension)};
}

/// Return the parts of a box on the two sides of a cut.
inline Box box_below(Box region, const Cut& cut) {
    region.upper[cut.axis] = std::min(region.upper[cut.axis], cut.at[cut.axis]);
    return region;
}
inline Box box_above(Box region, const Cut& cut) {
    region.lower[cut.axis] = std::max(region.lower[cut.axis], cut.at[cut.axis]);
    return region;
}

/// Returns the axis of each cut of a complete tree, in preorder.
inline std::vector<int> axes_of(std::span<const Cut> tree) {
    std::vector<int> axes;
    for (const Cut& cut : tree) axes.push_back(cut.axis);
    return axes;
}

/// A box without any bounds.
inline constexpr Box everywhere{Box{}.upper, Box{}.lower};

/// Returns the box between the cuts above a part. Its bounds may be reversed if the region is
/// empty. Throws Error for an illegal cut.
Box region_of(const Cuts& cuts, Part part);

/// Returns true if the cuts above a part leave it neither a position nor coincident points that a
/// cut divides. `region` is its region_of().
bool is_region_empty(const Cuts& cuts, Part part, const Box& region);

/// Returns true if a cut divides coincident points, and a closed box contains their position.
inline bool holds_divided_points(const Box& box, const Cut& cut, int dimension) {
    if (cut.divides == 0) return false;
    for (int a = 0; a < dimension; ++a)
        if (!(box.lower[a] <= cut.at[a] && cut.at[a] <= box.upper[a])) return false;
    return true;
}

}  // namespace rrcb
