#pragma once

#include "effects/effect.hpp"

#include <algorithm>
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

/// Times of a rigid body's contact with points, however short the steps are.
class ContactTimes {
  public:
    template <int D>
    explicit ContactTimes(const EffectBuilder<D>& builder)
        : spacing_(builder.scene.grid.spacing), wave_speed_(builder.wave_speed) {}

    /// Time in which a point loses its speed into a body of a speed and half of an overlap, s: that
    /// of a step with a Courant number of 0.3, or of a longer one.
    double contact(double speed, double time_step) const {
        constexpr double courant_number = 0.3;
        return std::max(courant_number * spacing_ / (wave_speed_ + std::abs(speed)), time_step);
    }

    /// Weight of a step in a mean over the last times in which a wave crosses six cells.
    double weight(double time_step) const {
        return -std::expm1(-time_step * wave_speed_ / (6 * spacing_));
    }

  private:
    double spacing_;     ///< m
    double wave_speed_;  ///< m/s
};

/// Speed that a body takes from a point within a contact time, m/s: that into the body, and half of
/// an overlap. A gap, an overlap below 0, may close in it; what is left of it counts below 0.
template <int D>
double lost_speed(const Slip<D>& slip, double overlap, double contact_time) {
    constexpr double recovery = 0.5;
    const double recovered = overlap < 0 ? overlap : recovery * overlap;
    return slip.inward + recovered / contact_time;
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
