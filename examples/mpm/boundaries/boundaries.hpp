#pragma once

#include "effects/stages.hpp"

namespace mpm {

/// Adds the kernels that hold the nodes on the sides of the domain: `walls` before they move,
/// `friction` after. Open sides need none.
///
/// Shape functions may reach beyond a wall. At rollers and fixed walls the sums of nodes there go
/// to their mirror images inside, with the signs that leave the wall at rest. At frictional walls
/// they meet the wall together with these.
template <int D>
void add_walls(const Scene& scene, double wave_speed, Stages<D>& stages);

/// Nodes of a patch, and those beyond frictional walls whose mirror images it has: they meet the
/// wall together.
template <int D>
NodeRange<D> with_images(const Scene& scene, NodeRange<D> nodes);

/// Whether a plane rubs the points (add_plane_friction) and holds no nodes (add_planes).
inline bool has_friction(const Plane& plane) {
    return plane.wall.kind == Wall::frictional && plane.wall.friction > 0;
}

/// Adds the kernels that hold the nodes with mass on the planes and behind them, after they have
/// moved. A direction that a wall holds stays held.
template <int D>
void add_planes(const Scene& scene, Stages<D>& stages);

/// Adds the kernels of the planes that push and rub the points at them, and the columns they need.
template <int D>
void add_plane_friction(const Scene& scene, double wave_speed, Particles& particles,
                        Stages<D>& stages);

/// Adds the kernels that move the nodes beyond walls as the mirror images of those inside. They
/// come after all kernels that change nodes inside.
template <int D>
void add_images(const Scene& scene, Stages<D>& stages);

}  // namespace mpm
