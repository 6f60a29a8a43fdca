#include "contact.hpp"

#include <mpm/effect.hpp>

namespace mpm {

namespace {

template <int D>
void hold(Node<D>& node, std::size_t axis) {
    node.momentum[axis] = 0;
    node.force[axis] = 0;
}

/// `inward` is +1 on a lower side and -1 on an upper one.
template <int D>
void hold(Node<D>& node, const Wall& wall, std::size_t axis, double inward, double time_step) {
    if (wall.kind == Wall::roller) return hold(node, axis);
    if (wall.kind == Wall::fixed) {
        for (std::size_t a = 0; a < D; ++a) hold(node, a);
    } else if (node.mass > 0) {
        Components<D> normal{};
        normal[axis] = inward;
        const Components<D> velocity = free_velocity<D>(node, time_step);
        give_velocity<D>(after_contact<D>(velocity, normal, wall.friction), time_step, node);
    }
}

/// Nodes on one side of the domain and beyond it.
template <int D>
NodeRange<D> nodes_at(const GridPatch<D>& patch, std::size_t axis, bool is_upper) {
    NodeRange<D> side = patch.nodes;
    side.first[axis] = is_upper ? patch.shape.num_cells[axis] : -patch.margin;
    side.count[axis] = 1 + patch.margin;
    return intersection<D>(side, patch.nodes);
}

template <int D>
void hold_side(GridPatch<D>& patch, const Wall& wall, std::size_t axis, bool is_upper,
               double time_step) {
    if (wall.kind == Wall::open) return;
    visit_nodes<D>(nodes_at(patch, axis, is_upper), [&](const std::array<int, D>& node) {
        hold<D>(patch.sums[patch.index(node)], wall, axis, is_upper ? -1 : 1, time_step);
    });
}

}  // namespace

template <int D>
NodeKernel<D> wall_kernel(const Walls& walls) {
    return [walls](GridPatch<D>& patch, const StepTime& step) {
        const std::array<const Wall*, 3> lower{&walls.left, &walls.bottom, &walls.back};
        const std::array<const Wall*, 3> upper{&walls.right, &walls.top, &walls.front};
        for (std::size_t axis = 0; axis < D; ++axis) {
            hold_side<D>(patch, *lower[axis], axis, false, step.time_step);
            hold_side<D>(patch, *upper[axis], axis, true, step.time_step);
        }
    };
}

template NodeKernel<2> wall_kernel<2>(const Walls&);
template NodeKernel<3> wall_kernel<3>(const Walls&);

}  // namespace mpm
