#include "contact.hpp"

#include <mpm/effect.hpp>

namespace mpm {

namespace {

template <int D>
void hold(Node<D>& node, std::size_t axis) {
    node.momentum[axis] = 0;
    node.force[axis] = 0;
}

template <int D>
void hold(Node<D>& node, Wall::Kind kind, std::size_t axis) {
    hold(node, axis);
    for (std::size_t a = 0; kind == Wall::fixed && a < D; ++a) hold(node, a);
}

/// Nodes on one side of the domain and beyond it.
template <int D>
NodeRange<D> nodes_at(const GridPatch<D>& patch, std::size_t axis, bool is_upper) {
    NodeRange<D> side = patch.nodes;
    side.first[axis] = is_upper ? patch.shape.num_cells[axis] : -patch.margin;
    side.count[axis] = 1 + patch.margin;
    return intersection<D>(side, patch.nodes);
}

/// Calls visit(index of a node, wall, axis, inward sign) for the nodes on all sides.
template <int D, typename Visit>
void visit_sides(const GridPatch<D>& patch, const Walls& walls, Visit visit) {
    const std::array<const Wall*, 3> lower{&walls.left, &walls.bottom, &walls.back};
    const std::array<const Wall*, 3> upper{&walls.right, &walls.top, &walls.front};
    for (std::size_t axis = 0; axis < D; ++axis)
        for (const bool is_upper : {false, true}) {
            const Wall& wall = is_upper ? *upper[axis] : *lower[axis];
            if (wall.kind == Wall::open) continue;
            visit_nodes<D>(nodes_at(patch, axis, is_upper), [&](const std::array<int, D>& node) {
                visit(patch.index(node), wall, axis, is_upper ? -1.0 : 1.0);
            });
        }
}

bool has(const Walls& walls, Wall::Kind kind) {
    for (const Wall* wall :
         {&walls.left, &walls.right, &walls.bottom, &walls.top, &walls.back, &walls.front})
        if (wall->kind == kind) return true;
    return false;
}

}  // namespace

template <int D>
void add_walls(const Walls& walls, Stages<D>& stages) {
    if (has(walls, Wall::roller) || has(walls, Wall::fixed))
        stages.constraints.push_back(
            {"walls", [walls](GridPatch<D>& patch, const StepTime&) {
                 visit_sides(patch, walls,
                             [&](std::size_t n, const Wall& wall, std::size_t axis, double) {
                                 if (wall.kind != Wall::frictional)
                                     hold(patch.sums[n], wall.kind, axis);
                             });
             }});
    if (has(walls, Wall::frictional))
        stages.moved.push_back(
            {"friction", [walls](GridPatch<D>& patch, const StepTime&) {
                 visit_sides(patch, walls,
                             [&](std::size_t n, const Wall& wall, std::size_t axis, double inward) {
                                 if (wall.kind != Wall::frictional) return;
                                 Surface<D> surface{.normal = {}, .friction = wall.friction};
                                 surface.normal[axis] = inward;
                                 meet<D>(surface, patch.motion[n]);
                             });
             }});
}

template void add_walls<2>(const Walls&, Stages<2>&);
template void add_walls<3>(const Walls&, Stages<3>&);

}  // namespace mpm
