#pragma once

#include "grid/grid.hpp"

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

/// Lets a node that has moved meet a surface.
template <int D>
inline void meet(const Surface<D>& surface, NodeMotion<D>& motion) {
    correct<D>(motion,
               [&](const Components<D>& velocity) { return after_contact<D>(surface, velocity); });
}

}  // namespace mpm
