#pragma once

#include "effects/stages.hpp"

namespace mpm {

/// Returns the scene with an open side and a plane in place of each wall that has friction. The
/// grid gets one more layer of cells behind the plane, because points sink into it a little.
Scene with_ground(Scene scene);

/// Adds the kernels that stop the nodes on the sides of the domain. Open sides get none. Walls with
/// friction must have been replaced by planes (with_ground).
template <int D>
void add_walls(const Scene& scene, Stages<D>& stages);

/// Adds the kernels of contact and friction between points and planes, and the columns they need.
template <int D>
void add_plane_friction(const Scene& scene, double wave_speed, Particles& particles,
                        Stages<D>& stages);

/// Adds the kernels for shape functions that reach beyond walls. Call it after all other kernels
/// that change nodes have been added.
///
/// The sums of nodes beyond a wall are added to their mirror images inside, with the signs that
/// keep the wall at rest. Afterwards the nodes beyond the wall move like their images.
template <int D>
void add_images(const Scene& scene, Stages<D>& stages);

}  // namespace mpm
