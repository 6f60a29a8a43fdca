#include <mpm/grid.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

NodeRange intersection(const NodeRange& a, const NodeRange& b) {
    NodeRange both;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        both.first[axis] = std::max(a.first[axis], b.first[axis]);
        both.count[axis] = std::min(a.first[axis] + a.count[axis], b.first[axis] + b.count[axis]) -
                           both.first[axis];
    }
    return both;
}

NodeRange nodes_of(const GridShape& shape, const Box& box) {
    const Vector grid_upper = shape.upper();
    NodeRange nodes;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const double lower = std::max(box.lower[axis], shape.lower[axis]);
        const double upper = std::min(box.upper[axis], grid_upper[axis]);
        if (!(lower <= upper)) return {};
        const int first = cell_of(shape, lower, axis);
        nodes.first[axis] = first;
        nodes.count[axis] = cell_of(shape, upper, axis) - first + 2;
    }
    return nodes;
}

void resize(GridPatch& patch, const NodeRange& nodes) {
    patch.nodes = nodes;
    const std::size_t num_nodes = nodes.empty() ? 0
                                                : static_cast<std::size_t>(nodes.count[0]) *
                                                      static_cast<std::size_t>(nodes.count[1]);
    patch.sums.resize(num_nodes);
    patch.motion.resize(num_nodes);
}

void move_nodes(GridPatch& patch, double time_step, double least_mass) {
    for (std::size_t n = 0; n < patch.sums.size(); ++n) {
        const Node& node = patch.sums[n];
        NodeMotion& motion = patch.motion[n];
        motion = {};
        if (!(node.mass > 0)) continue;
        for (std::size_t a = 0; a < 2; ++a) {
            const double old_velocity = node.momentum[a] / node.mass;
            const double impulse = time_step * node.force[a];
            motion.velocity_change[a] = impulse / node.mass;
            motion.velocity[a] = old_velocity + motion.velocity_change[a];
            motion.strain_velocity[a] = old_velocity + impulse / std::max(node.mass, least_mass);
        }
    }
}

}  // namespace mpm
