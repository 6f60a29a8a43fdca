#pragma once

#include <mpm/scene.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace mpm {

template <int D>
using Components = std::array<double, D>;

/// Sums over the points that reach a node.
template <int D>
struct NodeSums {
    double mass = 0;
    Components<D> momentum{};
    Components<D> force{};
};

template <int D>
inline void add(const NodeSums<D>& from, NodeSums<D>& to) {
    to.mass += from.mass;
    for (std::size_t a = 0; a < D; ++a) {
        to.momentum[a] += from.momentum[a];
        to.force[a] += from.force[a];
    }
}

/// The motion of a node that the points read.
template <int D>
struct NodeMotion {
    Components<D> velocity{};         ///< at the end of the step
    Components<D> velocity_change{};  ///< over the step
};

/// A box of nodes. The numbers of the nodes are those of the complete grid.
template <int D>
struct NodeRange {
    std::array<int, D> begin{};
    std::array<int, D> count{};

    bool operator==(const NodeRange&) const = default;
    bool empty() const {
        for (const int n : count)
            if (n <= 0) return true;
        return false;
    }
};

/// Returns the cell of a coordinate inside the grid. The upper face belongs to the last cell.
inline int cell_of(const GridShape& shape, double coordinate, std::size_t axis) {
    const double cells_per_metre = 1 / shape.spacing;
    const int cell = static_cast<int>((coordinate - shape.lower[axis]) * cells_per_metre);
    return cell < shape.num_cells[axis] ? cell : shape.num_cells[axis] - 1;
}

template <int D>
NodeRange<D> intersection(const NodeRange<D>& a, const NodeRange<D>& b);

/// Returns the nodes of all cells that a closed box touches, and `margin` more layers on each side.
/// The range is empty if the box is outside the grid.
template <int D>
NodeRange<D> nodes_of(const GridShape& shape, const Box& box, int margin = 0);

/// One rank's part of the background grid. The numbers of the nodes increase along x first.
template <int D>
struct GridPatch {
    GridShape shape;
    int margin = 0;  ///< layers of nodes beyond the grid's sides
    NodeRange<D> nodes;
    std::vector<NodeSums<D>> sums;
    std::vector<NodeMotion<D>> motion;
    std::vector<std::vector<double>> fields;  ///< more sums over the points, for effects

    /// Returns the number within the patch of a node of the complete grid.
    std::size_t index(const std::array<int, D>& node) const {
        std::size_t index = 0;
        for (std::size_t a = D; a-- > 0;)
            index = index * static_cast<std::size_t>(nodes.count[a]) +
                    static_cast<std::size_t>(node[a] - nodes.begin[a]);
        return index;
    }
};

/// Calls visit(node) for each node of a range, along x first.
template <int D, typename Visit>
void visit_nodes(const NodeRange<D>& range, Visit visit) {
    if (range.empty()) return;
    std::array<int, D> node = range.begin;
    for (;;) {
        visit(node);
        // Increments the node's indices like an odometer.
        std::size_t axis = 0;
        while (axis < D && ++node[axis] == range.begin[axis] + range.count[axis]) {
            node[axis] = range.begin[axis];
            ++axis;
        }
        if (axis == D) return;
    }
}

/// Gives the patch other nodes. Their values are undefined afterwards.
template <int D>
void resize(GridPatch<D>& patch, const NodeRange<D>& nodes);

/// Moves the nodes by the sums of a step.
///
/// Returns the speed of the fastest node, m/s. The speed of a node lighter than the lightest point
/// is computed with the mass of this point, because no point takes a larger share of the node's
/// velocity.
template <int D>
double move_nodes(GridPatch<D>& patch, double time_step, double lightest_point);

}  // namespace mpm
