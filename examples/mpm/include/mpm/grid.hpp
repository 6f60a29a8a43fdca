#pragma once

#include <mpm/scene.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace mpm {

/// What the points sum on a node, and neighbours sum over ranks: five doubles in one message.
struct Node {
    double mass = 0;
    Vector momentum{};
    Vector force{};
};

inline void add(const Node& from, Node& to) {
    to.mass += from.mass;
    for (std::size_t a = 0; a < 2; ++a) {
        to.momentum[a] += from.momentum[a];
        to.force[a] += from.force[a];
    }
}

/// What the points read from a node.
struct NodeMotion {
    Vector velocity{};         ///< at the end of the step
    Vector velocity_change{};  ///< over the step
    Vector strain_velocity{};  ///< the velocity whose gradient strains the points, see move_nodes
};

/// Rectangle of nodes, numbered over the whole grid.
struct NodeRange {
    std::array<int, 2> first{};
    std::array<int, 2> count{};

    bool empty() const { return count[0] <= 0 || count[1] <= 0; }
};

/// Cell of a coordinate inside the grid; the upper face belongs to the last cell.
inline int cell_of(const GridShape& shape, double coordinate, std::size_t axis) {
    const int cell = static_cast<int>((coordinate - shape.lower[axis]) / shape.spacing);
    return cell < shape.num_cells[axis] ? cell : shape.num_cells[axis] - 1;
}

NodeRange intersection(const NodeRange& a, const NodeRange& b);

/// Nodes of all cells a closed box touches; none when it lies outside the grid.
NodeRange nodes_of(const GridShape& shape, const Box& box);

/// One rank's piece of the background grid; nodes are numbered row by row.
struct GridPatch {
    GridShape shape;
    NodeRange nodes;
    std::vector<Node> sums;
    std::vector<NodeMotion> motion;

    /// Number within the patch of a node of the whole grid.
    std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j - nodes.first[1]) *
                   static_cast<std::size_t>(nodes.count[0]) +
               static_cast<std::size_t>(i - nodes.first[0]);
    }
};

/// Makes the patch hold other nodes; their values are undefined.
void resize(GridPatch& patch, const NodeRange& nodes);

/// A kernel that changes the sums of all nodes of a patch, at a time in seconds.
using NodeKernel = std::function<void(GridPatch&, double time)>;

/// Velocities at the end of a step from the sums.
///
/// A node that only the rim of a point's cell touches has next to no mass but a finite force. Its
/// acceleration is harmless where it is weighted by the same small shape function, but not in
/// the velocity gradient; there a mass of at least `least_mass` is used. Momentum stays exact.
void move_nodes(GridPatch& patch, double time_step, double least_mass);

}  // namespace mpm
