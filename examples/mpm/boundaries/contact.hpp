#pragma once

#include "grid/grid.hpp"

#include <array>
#include <cmath>

namespace mpm {

/// A rigid surface as a node meets it.
template <int D>
struct Surface {
    Components<D> normal;  ///< outward, of unit length
    double friction = 0;   ///< Coulomb's coefficient
};

/// Velocity after contact, without its part into the surface and less by friction along it.
///
/// A velocity that leaves the surface stays as it is. The tangential velocity goes down by at most
/// friction * the loss of the normal one (Bardenhagen, Brackbill and Sulsky 2000).
template <int D>
inline Components<D> after_contact(const Surface<D>& surface, const Components<D>& velocity) {
    double across = 0;
    for (std::size_t a = 0; a < D; ++a) across += velocity[a] * surface.normal[a];
    if (across >= 0) return velocity;
    Components<D> along{};
    double square = 0;
    for (std::size_t a = 0; a < D; ++a) {
        along[a] = velocity[a] - across * surface.normal[a];
        square += along[a] * along[a];
    }
    const double speed = std::sqrt(square);
    const double lost = -surface.friction * across;
    const double left = speed > lost ? 1 - lost / speed : 0;
    for (std::size_t a = 0; a < D; ++a) along[a] *= left;
    return along;
}

/// Velocities of a node beyond a surface and of its mirror image inside, after the surface has kept
/// their mean out of it, with equal impulses on both.
///
/// The surface lies where shape functions read the mean of the two. Equal impulses do no work where
/// it is at rest.
template <int D>
inline std::array<Components<D>, 2> after_contact(const Surface<D>& surface,
                                                  std::array<Components<D>, 2> velocities,
                                                  const std::array<double, 2>& masses) {
    Components<D> sum;
    for (std::size_t a = 0; a < D; ++a) sum[a] = velocities[0][a] + velocities[1][a];
    const Components<D> left = after_contact<D>(surface, sum);
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
