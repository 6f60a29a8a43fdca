#include "boundaries/boundaries.hpp"
#include "boundaries/contact.hpp"

#include <algorithm>
#include <optional>

namespace mpm {

namespace {

/// What the walls of a node leave a plane to hold.
template <int D>
struct Freedom {
    Components<D> normal;         ///< part of the plane's in the free directions, of unit length
    std::array<bool, D> is_free;  ///< whether walls leave the node free along an axis
};

/// Freedom of a node; none where walls hold it across the plane.
template <int D>
std::optional<Freedom<D>> freedom_of(const Ground<D>& ground, const Walls& walls,
                                     const GridShape& shape, const std::array<int, D>& node) {
    const std::array<const Wall*, 3> lower{&walls.left, &walls.bottom, &walls.back};
    const std::array<const Wall*, 3> upper{&walls.right, &walls.top, &walls.front};
    Freedom<D> freedom{ground.normal, {}};
    for (std::size_t a = 0; a < D; ++a) {
        Wall::Kind kind = Wall::open;
        if (node[a] <= 0) kind = lower[a]->kind;
        if (node[a] >= shape.num_cells[a]) kind = upper[a]->kind;
        if (kind == Wall::fixed) return std::nullopt;
        freedom.is_free[a] = kind != Wall::roller;
        if (!freedom.is_free[a]) freedom.normal[a] = 0;
    }
    double square = 0;
    for (const double component : freedom.normal) square += component * component;
    if (!(square > 0)) return std::nullopt;
    for (double& component : freedom.normal) component /= std::sqrt(square);
    return freedom;
}

/// Velocity of a node after a plane of a velocity has acted on it.
template <int D>
Components<D> left(Wall::Kind kind, const Freedom<D>& freedom, Components<D> of_plane,
                   Components<D> velocity) {
    const Components<D>& normal = freedom.normal;
    for (std::size_t a = 0; a < D; ++a)
        if (!freedom.is_free[a]) of_plane[a] = 0;
    if (kind == Wall::fixed) return of_plane;
    for (std::size_t a = 0; a < D; ++a) velocity[a] -= of_plane[a];
    const double across = along_normal<D>(normal, velocity);
    for (std::size_t a = 0; (kind == Wall::roller || across < 0) && a < D; ++a)
        velocity[a] -= across * normal[a];
    for (std::size_t a = 0; a < D; ++a) velocity[a] += of_plane[a];
    return velocity;
}

/// Calls visit(motion, freedom) for the nodes with mass that a plane acts on.
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
        const auto freedom = freedom_of<D>(ground, walls, patch.shape, node);
        if (freedom) visit(patch.motion[n], *freedom);
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
                         [&](NodeMotion<D>& motion, const Freedom<D>& freedom) {
                             correct<D>(motion, [&](const Components<D>& velocity) {
                                 return left<D>(kind, freedom, of_plane, velocity);
                             });
                         });
        };
        const auto hold_strain = [ground, kind, walls = scene.walls](GridPatch<D>& patch,
                                                                     const StepTime& now) {
            const double end = now.time + now.time_step;
            const Components<D> of_plane = ground.velocity(end);
            visit_ground(ground, end, walls, patch,
                         [&](NodeMotion<D>& motion, const Freedom<D>& freedom) {
                             motion.strain_velocity =
                                 left<D>(kind, freedom, of_plane, motion.strain_velocity);
                         });
        };
        stages.moved.push_back({"planes", hold});
        if (remaps_velocities(scene)) stages.remapped_velocities.push_back({"planes", hold_strain});
    }
}

template void add_planes<2>(const Scene&, Stages<2>&);
template void add_planes<3>(const Scene&, Stages<3>&);

}  // namespace mpm
