#pragma once

#include "effects/moving_ground.hpp"

#include <array>

namespace mpm {

/// Velocity of a node without its part into a surface.
template <int D>
inline Components<D> after_contact(const Components<D>& normal, Components<D> velocity) {
    const double across = along_normal<D>(normal, velocity);
    for (std::size_t a = 0; across < 0 && a < D; ++a) velocity[a] -= across * normal[a];
    return velocity;
}

/// Velocities of a node beyond a surface and of its mirror image inside, after the surface has kept
/// their mean out of it, with equal impulses on both.
///
/// The surface lies where shape functions read the mean of the two. Equal impulses do no work where
/// it is at rest.
template <int D>
inline std::array<Components<D>, 2> after_contact(const Components<D>& normal,
                                                  std::array<Components<D>, 2> velocities,
                                                  const std::array<double, 2>& masses) {
    Components<D> sum;
    for (std::size_t a = 0; a < D; ++a) sum[a] = velocities[0][a] + velocities[1][a];
    const Components<D> left = after_contact<D>(normal, sum);
    for (std::size_t a = 0; a < D; ++a) {
        const double change = left[a] - sum[a];
        velocities[0][a] += masses[1] / (masses[0] + masses[1]) * change;
        velocities[1][a] += masses[0] / (masses[0] + masses[1]) * change;
    }
    return velocities;
}

/// Corrects all velocities of a node that has moved by `left(velocity)`, so that points are
/// strained, moved and pushed by what it leaves.
template <int D, typename Left>
inline void correct(NodeMotion<D>& motion, Left left) {
    const Components<D> velocity = left(motion.velocity);
    for (std::size_t a = 0; a < D; ++a)
        motion.velocity_change[a] += velocity[a] - motion.velocity[a];
    motion.velocity = velocity;
    motion.strain_velocity = left(motion.strain_velocity);
}

}  // namespace mpm
