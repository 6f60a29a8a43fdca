#include "boundaries/boundaries.hpp"
#include "boundaries/contact.hpp"

#include <optional>

namespace mpm {

namespace {

/// A plane as a step needs it.
template <int D>
struct Ground {
    Wall wall;
    Components<D> normal;  ///< of unit length
    double level;          ///< of the plane along the normal, m
};

template <int D>
Ground<D> ground_of(const Plane& plane) {
    double square = 0;
    for (std::size_t a = 0; a < D; ++a) square += plane.normal[a] * plane.normal[a];
    Ground<D> ground{plane.wall, {}, 0};
    for (std::size_t a = 0; a < D; ++a) {
        ground.normal[a] = plane.normal[a] / std::sqrt(square);
        ground.level += ground.normal[a] * plane.point[a];
    }
    return ground;
}

template <int D>
bool is_behind(const Ground<D>& ground, const Vector& at, double tolerance) {
    double height = -ground.level;
    for (std::size_t a = 0; a < D; ++a) height += ground.normal[a] * at[a];
    return height <= tolerance;
}

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

/// Velocity of a node after a plane has acted on it.
template <int D>
Components<D> left(const Wall& wall, const Components<D>& normal, Components<D> velocity) {
    if (wall.kind == Wall::fixed) return {};
    if (wall.kind == Wall::frictional)
        return after_contact<D>({.normal = normal, .friction = wall.friction}, velocity);
    double across = 0;
    for (std::size_t a = 0; a < D; ++a) across += velocity[a] * normal[a];
    for (std::size_t a = 0; a < D; ++a) velocity[a] -= across * normal[a];
    return velocity;
}

/// Calls visit(motion, normal) for the nodes with mass that a plane acts on.
template <int D, typename Visit>
void visit_ground(const Ground<D>& ground, const Walls& walls, GridPatch<D>& patch, Visit visit) {
    const double tolerance = 1e-9 * patch.shape.spacing;
    visit_nodes<D>(patch.nodes, [&](const std::array<int, D>& node) {
        const std::size_t n = patch.index(node);
        if (!(patch.sums[n].mass > 0) || !is_behind(ground, patch.position(node), tolerance))
            return;
        const auto normal = free_normal<D>(ground, walls, patch.shape, node);
        if (normal) visit(patch.motion[n], *normal);
    });
}

}  // namespace

template <int D>
void add_planes(const Scene& scene, Stages<D>& stages) {
    for (const Plane& plane : scene.planes) {
        const Ground<D> ground = ground_of<D>(plane);
        const auto hold = [ground, walls = scene.walls](GridPatch<D>& patch, const StepTime&) {
            visit_ground(ground, walls, patch,
                         [&](NodeMotion<D>& motion, const Components<D>& normal) {
                             correct<D>(motion, [&](const Components<D>& velocity) {
                                 return left<D>(ground.wall, normal, velocity);
                             });
                         });
        };
        const auto hold_strain = [ground, walls = scene.walls](GridPatch<D>& patch,
                                                               const StepTime&) {
            visit_ground(
                ground, walls, patch, [&](NodeMotion<D>& motion, const Components<D>& normal) {
                    motion.strain_velocity = left<D>(ground.wall, normal, motion.strain_velocity);
                });
        };
        stages.moved.push_back({"planes", hold});
        if (remaps_velocities(scene)) stages.remapped_velocities.push_back({"planes", hold_strain});
    }
}

template void add_planes<2>(const Scene&, Stages<2>&);
template void add_planes<3>(const Scene&, Stages<3>&);

}  // namespace mpm
