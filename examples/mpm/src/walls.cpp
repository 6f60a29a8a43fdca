#include <mpm/effects.hpp>

namespace mpm {

namespace {

void hold(Node& node, std::size_t axis) {
    node.momentum[axis] = 0;
    node.force[axis] = 0;
}

void hold(Node& node, Wall wall, std::size_t normal) {
    if (wall == Wall::open) return;
    hold(node, normal);
    if (wall == Wall::fixed) hold(node, 1 - normal);
}

void apply_across_x(GridPatch& patch, int i, Wall wall) {
    const NodeRange& nodes = patch.nodes;
    if (i < nodes.first[0] || i >= nodes.first[0] + nodes.count[0]) return;
    for (int j = nodes.first[1]; j < nodes.first[1] + nodes.count[1]; ++j)
        hold(patch.sums[patch.index(i, j)], wall, 0);
}

void apply_across_y(GridPatch& patch, int j, Wall wall) {
    const NodeRange& nodes = patch.nodes;
    if (j < nodes.first[1] || j >= nodes.first[1] + nodes.count[1]) return;
    for (int i = nodes.first[0]; i < nodes.first[0] + nodes.count[0]; ++i)
        hold(patch.sums[patch.index(i, j)], wall, 1);
}

}  // namespace

NodeKernel wall_kernel(const Walls& walls) {
    return [walls](GridPatch& patch, double) {
        apply_across_x(patch, 0, walls.left);
        apply_across_x(patch, patch.shape.num_cells[0], walls.right);
        apply_across_y(patch, 0, walls.bottom);
        apply_across_y(patch, patch.shape.num_cells[1], walls.top);
    };
}

}  // namespace mpm
