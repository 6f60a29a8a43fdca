#include "boundaries/boundaries.hpp"

namespace mpm {

namespace {

template <int D>
void stop(NodeSums<D>& node, std::size_t axis) {
    node.momentum[axis] = 0;
    node.force[axis] = 0;
}

template <int D>
void stop(NodeSums<D>& node, Wall::Kind kind, std::size_t axis) {
    stop(node, axis);
    for (std::size_t a = 0; kind == Wall::fixed && a < D; ++a) stop(node, a);
}

/// Returns the nodes on one side of the domain and beyond it.
template <int D>
NodeRange<D> nodes_at(const GridPatch<D>& patch, std::size_t axis, bool is_upper) {
    NodeRange<D> side = patch.nodes;
    side.begin[axis] = is_upper ? patch.shape.num_cells[axis] : -patch.margin;
    side.count[axis] = 1 + patch.margin;
    return intersection<D>(side, patch.nodes);
}

/// Calls visit(node, wall, axis, inward sign) for the nodes on all sides and beyond.
template <int D, typename Visit>
void visit_sides(const GridPatch<D>& patch, const Walls& walls, Visit visit) {
    const std::array<const Wall*, 3> lower{&walls.left, &walls.bottom, &walls.back};
    const std::array<const Wall*, 3> upper{&walls.right, &walls.top, &walls.front};
    for (std::size_t axis = 0; axis < D; ++axis)
        for (const bool is_upper : {false, true}) {
            const Wall& wall = is_upper ? *upper[axis] : *lower[axis];
            if (wall.kind == Wall::open) continue;
            visit_nodes<D>(nodes_at(patch, axis, is_upper), [&](const std::array<int, D>& node) {
                visit(node, wall, axis, is_upper ? -1.0 : 1.0);
            });
        }
}

/// Returns the index along an axis of the nodes on a side.
template <int D>
int side_of(const GridPatch<D>& patch, std::size_t axis, double inward) {
    return inward > 0 ? 0 : patch.shape.num_cells[axis];
}

bool has_walls(const Walls& walls) {
    for (const Wall* wall :
         {&walls.left, &walls.right, &walls.bottom, &walls.top, &walls.back, &walls.front})
        if (wall->kind != Wall::open) return true;
    return false;
}

/// Calls visit(node beyond a wall, its mirror image, wall, axis) for the nodes of a patch. A patch
/// that reaches beyond a wall also contains the layer of images.
template <int D, typename Visit>
void visit_images(const GridPatch<D>& patch, const Walls& walls, Visit visit) {
    visit_sides(patch, walls,
                [&](std::array<int, D> node, const Wall& wall, std::size_t axis, double inward) {
                    const int side = side_of(patch, axis, inward);
                    if (node[axis] == side) return;
                    const std::size_t beyond = patch.index(node);
                    node[axis] = 2 * side - node[axis];
                    visit(beyond, patch.index(node), wall, axis);
                });
}

/// Returns the sign of a component of a vector in the mirror image.
double parity(const Wall& wall, std::size_t axis, std::size_t component) {
    return wall.kind == Wall::fixed || component == axis ? -1 : 1;
}

/// Adds the sums and fields of nodes beyond a wall to their images inside, and clears them.
/// `components` has the component of each field that is part of a vector, and -1 for a scalar.
template <int D>
void fold(const Walls& walls, const std::vector<int>& components, GridPatch<D>& patch) {
    visit_images(
        patch, walls,
        [&](std::size_t beyond, std::size_t image, const Wall& wall, std::size_t axis) {
            NodeSums<D>& from = patch.sums[beyond];
            NodeSums<D>& to = patch.sums[image];
            to.mass += from.mass;
            for (std::size_t a = 0; a < D; ++a) {
                to.momentum[a] += parity(wall, axis, a) * from.momentum[a];
                to.force[a] += parity(wall, axis, a) * from.force[a];
            }
            from = {};
            for (std::size_t f = 0; f < components.size(); ++f) {
                const int component = components[f];
                const double sign =
                    component < 0 ? 1 : parity(wall, axis, static_cast<std::size_t>(component));
                patch.fields[f][image] += sign * patch.fields[f][beyond];
                patch.fields[f][beyond] = 0;
            }
        });
}

/// Moves the nodes beyond a wall like the mirror images of those inside.
template <int D>
void mirror(const Walls& walls, GridPatch<D>& patch) {
    visit_images(patch, walls,
                 [&](std::size_t beyond, std::size_t image, const Wall& wall, std::size_t axis) {
                     const NodeMotion<D>& from = patch.motion[image];
                     NodeMotion<D>& to = patch.motion[beyond];
                     for (std::size_t a = 0; a < D; ++a) {
                         const double sign = parity(wall, axis, a);
                         to.velocity[a] = sign * from.velocity[a];
                         to.velocity_change[a] = sign * from.velocity_change[a];
                     }
                 });
}

/// Returns whether shape functions reach beyond walls.
bool has_images(const Scene& scene) {
    return scene.shape_function != ShapeFunction::linear && has_walls(scene.walls);
}

}  // namespace

template <int D>
void add_walls(const Scene& scene, Stages<D>& stages) {
    const Walls& walls = scene.walls;
    if (!has_walls(walls)) return;
    stages.constraints.push_back(
        {"walls", [walls](GridPatch<D>& patch, const StepTime&) {
             visit_sides(patch, walls,
                         [&](const std::array<int, D>& node, const Wall& wall, std::size_t axis,
                             double) { stop(patch.sums[patch.index(node)], wall.kind, axis); });
         }});
}

template <int D>
void add_images(const Scene& scene, Stages<D>& stages) {
    if (!has_images(scene)) return;
    std::vector<int> components;
    for (const NodeField& field : stages.fields) components.push_back(field.component);
    stages.scatters.push_back(
        {"walls", [walls = scene.walls, components](const Particles&, std::span<const CellRun<D>>,
                                                    GridPatch<D>& patch) {
             fold(walls, components, patch);
         }});
    stages.moved.push_back({"walls", [walls = scene.walls](GridPatch<D>& patch, const StepTime&) {
                                mirror(walls, patch);
                            }});
}

template void add_walls<2>(const Scene&, Stages<2>&);
template void add_walls<3>(const Scene&, Stages<3>&);
template void add_images<2>(const Scene&, Stages<2>&);
template void add_images<3>(const Scene&, Stages<3>&);

}  // namespace mpm
