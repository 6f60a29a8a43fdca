#pragma once

#include <mpm/grid.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

/// Takes out what goes against an outward normal, and Coulomb friction along the surface.
///
/// A velocity that leaves the surface stays as it is. The tangential velocity is brought down by
/// at most friction * what the normal one lost (Bardenhagen, Brackbill and Sulsky 2000).
template <int D>
inline Components<D> after_contact(const Components<D>& velocity, const Components<D>& normal,
                                   double friction) {
    double across = 0;
    for (std::size_t a = 0; a < D; ++a) across += velocity[a] * normal[a];
    if (across >= 0) return velocity;
    Components<D> along{};
    double square = 0;
    for (std::size_t a = 0; a < D; ++a) {
        along[a] = velocity[a] - across * normal[a];
        square += along[a] * along[a];
    }
    const double speed = std::sqrt(square), lost = -friction * across;
    const double left = speed > lost ? 1 - lost / speed : 0;
    for (double& component : along) component *= left;
    return along;
}

/// Lets a node that has moved meet a surface: all its velocities are corrected, so that points are
/// strained, moved and pushed by what the surface leaves.
template <int D>
inline void meet(const Components<D>& normal, double friction, NodeMotion<D>& motion) {
    const Components<D> velocity = after_contact<D>(motion.velocity, normal, friction);
    for (std::size_t a = 0; a < D; ++a)
        motion.velocity_change[a] += velocity[a] - motion.velocity[a];
    motion.velocity = velocity;
    motion.strain_velocity = after_contact<D>(motion.strain_velocity, normal, friction);
}

}  // namespace mpm
