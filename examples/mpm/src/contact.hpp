#pragma once

#include <mpm/grid.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

/// Sets force and momentum so that the node ends the step with a velocity.
template <int D>
inline void give_velocity(const Components<D>& velocity, double time_step, Node<D>& node) {
    for (std::size_t a = 0; a < D; ++a)
        node.force[a] = (node.mass * velocity[a] - node.momentum[a]) / time_step;
}

/// Velocity the node would end the step with.
template <int D>
inline Components<D> free_velocity(const Node<D>& node, double time_step) {
    Components<D> velocity{};
    for (std::size_t a = 0; a < D; ++a)
        velocity[a] = (node.momentum[a] + time_step * node.force[a]) / node.mass;
    return velocity;
}

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

}  // namespace mpm
