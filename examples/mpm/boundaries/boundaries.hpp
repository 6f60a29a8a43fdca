#pragma once

#include "effects/stages.hpp"

namespace mpm {

/// The scene with an open side and a plane in place of each wall that has friction. Points sink
/// into a plane a little: behind it the grid has a layer of cells more.
Scene with_ground(Scene scene);

/// Adds the kernels that hold the nodes on the sides of the domain. Open sides need none. Walls
/// with friction must be planes (with_ground).
template <int D>
void add_walls(const Scene& scene, Stages<D>& stages);

/// Adds the kernels of the planes that push and rub the points at them, and the columns they need.
template <int D>
void add_plane_friction(const Scene& scene, double wave_speed, Particles& particles,
                        Stages<D>& stages);

/// Adds the kernels for functions that reach beyond walls; after all others that change nodes.
///
/// The sums of nodes there go to their mirror images inside, with the signs that leave the wall at
/// rest; then the nodes beyond move as their images.
template <int D>
void add_images(const Scene& scene, Stages<D>& stages);

}  // namespace mpm
