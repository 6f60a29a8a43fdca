#include "boundaries/boundaries.hpp"
#include "boundaries/contact.hpp"

#include <algorithm>
#include <optional>

namespace mpm {

namespace {

/// Part of the plane's normal in the directions that the walls of a node leave free; none where
/// they hold the node.
template <int D>
std::optional<Components<D>> free_normal(const Ground<D>& ground, const Walls& walls,
                                         const GridShape& shape, const std::array<int, D>& node) {
    const std::array<const Wall*, 3> lower{&walls.left, &walls.bottom, &walls.back};
    const std::array<const Wall*, 3> upper{&walls.right, &walls.top, &walls.front};
    Components<D> normal = ground.normal;
    for (std::size_t a = 0; a < D; ++a) {
        Wall::Kind kind = Wall::open;
        if (node[a] <= 0) kind = lower[a]->kind;
        if (node[a] >= shape.num_cells[a]) kind = upper[a]->kind;
        if (kind == Wall::fixed) return std::nullopt;
        if (kind == Wall::roller) normal[a] = 0;
    }
    double square = 0;
    for (const double component : normal) square += component * component;
    if (!(square > 0)) return std::nullopt;
    for (double& component : normal) component /= std::sqrt(square);
    return normal;
}

/// Velocity of a node after a plane of a velocity has acted on it.
template <int D>
Components<D> left(Wall::Kind kind, const Components<D>& normal, const Components<D>& of_plane,
                   Components<D> velocity) {
    if (kind == Wall::fixed) return of_plane;
    for (std::size_t a = 0; a < D; ++a) velocity[a] -= of_plane[a];
    const double across = along_normal<D>(normal, velocity);
    for (std::size_t a = 0; (kind == Wall::roller || across < 0) && a < D; ++a)
        velocity[a] -= across * normal[a];
    for (std::size_t a = 0; a < D; ++a) velocity[a] += of_plane[a];
    return velocity;
}

/// Calls visit(motion, normal) for the nodes with mass that a plane acts on.
template <int D, typename Visit>
void visit_ground(const Ground<D>& ground, double time, const Walls& walls, GridPatch<D>& patch,
                  Visit visit) {
    const double tolerance = 1e-9 * patch.shape.spacing;
    visit_nodes<D>(patch.nodes, [&](const std::array<int, D>& node) {
        const std::size_t n = patch.index(node);
        const Vector at = patch.position(node);
        Components<D> place;
        std::copy_n(at.begin(), D, place.begin());
        if (!(patch.sums[n].mass > 0) || ground.height(ground.origin(place, time)) > tolerance)
            return;
        const auto normal = free_normal<D>(ground, walls, patch.shape, node);
        if (normal) visit(patch.motion[n], *normal);
    });
}

}  // namespace

template <int D>
void add_planes(const Scene& scene, Stages<D>& stages) {
    for (const Plane& plane : scene.planes) {
        if (has_friction(plane.wall)) continue;
        const Ground<D> ground(plane);
        const Wall::Kind kind = plane.wall.kind;
        const auto hold = [ground, kind, walls = scene.walls](GridPatch<D>& patch,
                                                              const StepTime& now) {
            const double end = now.time + now.time_step;
            const Components<D> of_plane = ground.velocity(end);
            visit_ground(ground, end, walls, patch,
                         [&](NodeMotion<D>& motion, const Components<D>& normal) {
                             correct<D>(motion, [&](const Components<D>& velocity) {
                                 return left<D>(kind, normal, of_plane, velocity);
                             });
                         });
        };
        const auto hold_strain = [ground, kind, walls = scene.walls](GridPatch<D>& patch,
                                                                     const StepTime& now) {
            const double end = now.time + now.time_step;
            const Components<D> of_plane = ground.velocity(end);
            visit_ground(ground, end, walls, patch,
                         [&](NodeMotion<D>& motion, const Components<D>& normal) {
                             motion.strain_velocity =
                                 left<D>(kind, normal, of_plane, motion.strain_velocity);
                         });
        };
        stages.moved.push_back({"planes", hold});
        if (remaps_velocities(scene)) stages.remapped_velocities.push_back({"planes", hold_strain});
    }
}

template void add_planes<2>(const Scene&, Stages<2>&);
template void add_planes<3>(const Scene&, Stages<3>&);

}  // namespace mpm
