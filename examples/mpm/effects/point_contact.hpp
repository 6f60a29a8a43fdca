#pragma once

#include "grid/grid.hpp"

#include <cmath>

namespace mpm {

/// Velocity of a point relative to a rigid body: into its surface and along it, m/s.
template <int D>
struct Slip {
    double inward = 0;
    Components<D> along{};
    double speed = 0;  ///< along
};

template <int D>
Slip<D> slip_of(const Components<D>& relative_velocity, const Components<D>& normal) {
    Slip<D> slip{.along = relative_velocity};
    for (std::size_t a = 0; a < D; ++a) slip.inward -= relative_velocity[a] * normal[a];
    double square = 0;
    for (std::size_t a = 0; a < D; ++a) {
        slip.along[a] += slip.inward * normal[a];
        square += slip.along[a] * slip.along[a];
    }
    slip.speed = std::sqrt(square);
    return slip;
}

/// Speed that a body takes from a point in a step, m/s: that into the body, and half of an overlap.
/// A gap, an overlap below 0, may close within the step; what is left of it counts below 0.
template <int D>
double lost_speed(const Slip<D>& slip, double overlap, double time_step) {
    constexpr double recovery = 0.5;
    const double recovered = overlap < 0 ? overlap : recovery * overlap;
    return slip.inward + recovered / time_step;
}

/// Force of a body on a point: `push` out of it, N, and at most `friction` against the slip.
template <int D>
Components<D> contact_force(const Slip<D>& slip, const Components<D>& normal, double push,
                            double friction) {
    Components<D> force;
    for (std::size_t a = 0; a < D; ++a) {
        force[a] = push * normal[a];
        if (slip.speed > 0) force[a] -= friction * slip.along[a] / slip.speed;
    }
    return force;
}

}  // namespace mpm
