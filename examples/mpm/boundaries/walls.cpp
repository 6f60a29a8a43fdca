#include "boundaries/boundaries.hpp"
#include "boundaries/contact.hpp"

#include <algorithm>

namespace mpm {

namespace {

template <int D>
void hold(NodeSums<D>& node, std::size_t axis) {
    node.momentum[axis] = 0;
    node.force[axis] = 0;
}

template <int D>
void hold(NodeSums<D>& node, Wall::Kind kind, std::size_t axis) {
    hold(node, axis);
    for (std::size_t a = 0; kind == Wall::fixed && a < D; ++a) hold(node, a);
}

/// Nodes on one side of the domain and beyond it.
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

/// Number along an axis of the nodes on a side, which lies inward from what is beyond.
template <int D>
int side_of(const GridPatch<D>& patch, std::size_t axis, double inward) {
    return inward > 0 ? 0 : patch.shape.num_cells[axis];
}

bool has(const Walls& walls, Wall::Kind kind) {
    for (const Wall* wall :
         {&walls.left, &walls.right, &walls.bottom, &walls.top, &walls.back, &walls.front})
        if (wall->kind == kind) return true;
    return false;
}

/// Calls visit(node beyond a roller or fixed wall, its mirror image, wall, axis) for the nodes of a
/// patch. A patch that reaches beyond a wall has the layer of images, too.
template <int D, typename Visit>
void visit_images(const GridPatch<D>& patch, const Walls& walls, Visit visit) {
    visit_sides(patch, walls,
                [&](std::array<int, D> node, const Wall& wall, std::size_t axis, double inward) {
                    const int side = side_of(patch, axis, inward);
                    if (node[axis] == side || wall.kind == Wall::frictional) return;
                    const std::size_t beyond = patch.index(node);
                    node[axis] = 2 * side - node[axis];
                    visit(beyond, patch.index(node), wall, axis);
                });
}

/// Sign that a component of a vector has in the mirror image.
double parity(const Wall& wall, std::size_t axis, std::size_t component) {
    return wall.kind == Wall::fixed || component == axis ? -1 : 1;
}

/// One of the velocities of a node.
template <int D>
using Velocity = Components<D> NodeMotion<D>::*;

template <int D>
void set_velocity(NodeMotion<D>& motion, Velocity<D> which, const Components<D>& velocity) {
    for (std::size_t a = 0; which == &NodeMotion<D>::velocity && a < D; ++a)
        motion.velocity_change[a] += velocity[a] - motion.velocity[a];
    motion.*which = velocity;
}

/// Lets a node on a frictional wall or beyond meet it together with its mirror image inside, which
/// on the wall is the node itself.
template <int D>
void meet_wall(const Components<D>& normal, std::size_t n, std::size_t image, Velocity<D> which,
               GridPatch<D>& patch) {
    if (n == image)
        return set_velocity<D>(patch.motion[n], which,
                               after_contact<D>(normal, patch.motion[n].*which));
    const std::array masses{patch.sums[n].mass, patch.sums[image].mass};
    if (!(masses[0] > 0)) return;
    const auto left =
        after_contact<D>(normal, {patch.motion[n].*which, patch.motion[image].*which}, masses);
    set_velocity<D>(patch.motion[n], which, left[0]);
    set_velocity<D>(patch.motion[image], which, left[1]);
}

/// Lets the nodes on frictional walls and beyond meet them; those beyond together with their mirror
/// images inside.
template <int D>
void meet_walls(const Walls& walls, Velocity<D> which, GridPatch<D>& patch) {
    visit_sides(patch, walls,
                [&](std::array<int, D> node, const Wall& wall, std::size_t axis, double inward) {
                    if (wall.kind != Wall::frictional) return;
                    const std::size_t n = patch.index(node);
                    node[axis] = 2 * side_of(patch, axis, inward) - node[axis];
                    Components<D> normal{};
                    normal[axis] = inward;
                    meet_wall<D>(normal, n, patch.index(node), which, patch);
                });
}

/// Holds the strain velocities once they are mapped back to the nodes.
template <int D>
void hold_strain(const Walls& walls, GridPatch<D>& patch) {
    visit_sides(patch, walls,
                [&](const std::array<int, D>& node, const Wall& wall, std::size_t axis, double) {
                    Components<D>& velocity = patch.motion[patch.index(node)].strain_velocity;
                    if (wall.kind == Wall::fixed)
                        velocity = {};
                    else if (wall.kind == Wall::roller)
                        velocity[axis] = 0;
                });
    meet_walls<D>(walls, &NodeMotion<D>::strain_velocity, patch);
}

/// Adds the sums of nodes beyond a wall to their images inside, and clears them.
template <int D>
void fold(const Walls& walls, GridPatch<D>& patch) {
    visit_images(patch, walls,
                 [&](std::size_t beyond, std::size_t image, const Wall& wall, std::size_t axis) {
                     NodeSums<D>& from = patch.sums[beyond];
                     NodeSums<D>& to = patch.sums[image];
                     to.mass += from.mass;
                     for (std::size_t a = 0; a < D; ++a) {
                         to.momentum[a] += parity(wall, axis, a) * from.momentum[a];
                         to.force[a] += parity(wall, axis, a) * from.force[a];
                     }
                     from = {};
                 });
}

/// Folds the fields of effects, each a scalar or a component of a vector.
template <int D>
void fold_fields(const Walls& walls, const std::vector<int>& components, GridPatch<D>& patch) {
    visit_images(
        patch, walls,
        [&](std::size_t beyond, std::size_t image, const Wall& wall, std::size_t axis) {
            for (std::size_t f = 0; f < components.size(); ++f) {
                const int component = components[f];
                const double sign =
                    component < 0 ? 1 : parity(wall, axis, static_cast<std::size_t>(component));
                patch.fields[f][image] += sign * patch.fields[f][beyond];
                patch.fields[f][beyond] = 0;
            }
        });
}

/// Moves the nodes beyond a wall as the mirror images of those inside.
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
                         to.strain_velocity[a] = sign * from.strain_velocity[a];
                     }
                 });
}

template <int D>
void add_remapped_walls(const Scene& scene, Stages<D>& stages) {
    const Walls& walls = scene.walls;
    if (!has(walls, Wall::roller) && !has(walls, Wall::fixed) && !has(walls, Wall::frictional))
        return;
    stages.remapped_velocities.push_back(
        {"walls", [walls](GridPatch<D>& patch, const StepTime&) { hold_strain(walls, patch); }});
}

/// Whether shape functions reach beyond walls that hold nodes.
bool has_images(const Scene& scene) {
    return scene.shape_function != ShapeFunction::linear &&
           (has(scene.walls, Wall::roller) || has(scene.walls, Wall::fixed));
}

}  // namespace

template <int D>
void add_walls(const Scene& scene, Stages<D>& stages) {
    const Walls& walls = scene.walls;
    if (has_images(scene)) {
        stages.scatters.push_back({"walls", [walls](const Particles&, std::span<const CellRun<D>>,
                                                    GridPatch<D>& patch) { fold(walls, patch); }});
        if (remaps_velocities(scene)) stages.velocity_scatters.push_back(stages.scatters.back());
    }
    if (has(walls, Wall::roller) || has(walls, Wall::fixed))
        stages.constraints.push_back(
            {"walls", [walls](GridPatch<D>& patch, const StepTime&) {
                 visit_sides(patch, walls,
                             [&](const std::array<int, D>& node, const Wall& wall, std::size_t axis,
                                 double) {
                                 if (wall.kind != Wall::frictional)
                                     hold(patch.sums[patch.index(node)], wall.kind, axis);
                             });
             }});
    if (has(walls, Wall::frictional))
        stages.moved.push_back({"walls", [walls](GridPatch<D>& patch, const StepTime&) {
                                    meet_walls<D>(walls, &NodeMotion<D>::velocity, patch);
                                    meet_walls<D>(walls, &NodeMotion<D>::strain_velocity, patch);
                                }});
    if (remaps_velocities(scene)) add_remapped_walls(scene, stages);
}

template <int D>
void add_images(const Scene& scene, Stages<D>& stages) {
    if (!has_images(scene)) return;
    std::vector<int> components;
    for (const NodeField& field : stages.fields) components.push_back(field.component);
    if (!components.empty())
        stages.scatters.push_back(
            {"walls", [walls = scene.walls, components](
                          const Particles&, std::span<const CellRun<D>>, GridPatch<D>& patch) {
                 fold_fields(walls, components, patch);
             }});
    stages.moved.push_back({"walls", [walls = scene.walls](GridPatch<D>& patch, const StepTime&) {
                                mirror(walls, patch);
                            }});
    if (remaps_velocities(scene)) stages.remapped_velocities.push_back(stages.moved.back());
}

template <int D>
NodeRange<D> with_images(const Scene& scene, NodeRange<D> nodes) {
    if (scene.shape_function == ShapeFunction::linear || nodes.empty()) return nodes;
    const std::array<const Wall*, 3> lower{&scene.walls.left, &scene.walls.bottom,
                                           &scene.walls.back};
    const std::array<const Wall*, 3> upper{&scene.walls.right, &scene.walls.top,
                                           &scene.walls.front};
    for (std::size_t a = 0; a < D; ++a) {
        const int last = scene.grid.num_cells[a] + 1;
        int end = nodes.begin[a] + nodes.count[a];
        if (upper[a]->kind == Wall::frictional && end >= last - 1) end = last + 1;
        if (lower[a]->kind == Wall::frictional && nodes.begin[a] <= 1) nodes.begin[a] = -1;
        nodes.count[a] = end - nodes.begin[a];
    }
    return nodes;
}

template NodeRange<2> with_images<2>(const Scene&, NodeRange<2>);
template NodeRange<3> with_images<3>(const Scene&, NodeRange<3>);
template void add_walls<2>(const Scene&, Stages<2>&);
template void add_walls<3>(const Scene&, Stages<3>&);
template void add_images<2>(const Scene&, Stages<2>&);
template void add_images<3>(const Scene&, Stages<3>&);

}  // namespace mpm
