#pragma once

#include "effects/stages.hpp"

namespace mpm {

/// The scene with an open side and a plane in place of each wall that has friction or moves. Points
/// sink into a plane a little: behind it the grid has a layer of cells more.
Scene with_ground(Scene scene);

/// Adds the kernels that hold the nodes on the sides of the domain, those of walls that bodies may
/// leave after they have moved. Open sides need none. Walls with friction or a
/// motion must be planes (with_ground).
///
/// Shape functions may reach beyond a wall. At rollers and fixed walls the sums of nodes there go
/// to their mirror images inside, with the signs that leave the wall at rest. At frictional walls
/// they meet the wall together with these.
template <int D>
void add_walls(const Scene& scene, Stages<D>& stages);

/// Nodes of a patch, and those beyond frictional walls whose mirror images it has: they meet the
/// wall together.
template <int D>
NodeRange<D> with_images(const Scene& scene, NodeRange<D> nodes);

/// Whether a wall or plane rubs the points (add_plane_friction) and holds no nodes (add_planes).
inline bool has_friction(const Wall& wall) {
    return wall.kind == Wall::frictional && wall.friction > 0;
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
