#pragma once

#include "materials/elastic.hpp"

#include <cmath>
#include <limits>

namespace mpm {

/// Cone sqrt(J2) + friction * mean <= cohesion with mean <= tension.
struct DruckerPrager {
    double friction = 0;
    double cohesion = 0;  ///< Pa
    double tension = 0;   ///< Pa, at most the apex
};

/// The cone that fails in plane strain exactly where Mohr-Coulomb without dilation does: friction
/// sin(phi), cohesion c cos(phi). The angle is in degrees; the tension limit bounds the mean
/// stress.
DruckerPrager matched_cone(double cohesion, double friction_angle, double tension_cut_off);

/// Admissible stress that a trial stress returns to: the mean is cut to the tension limit, then the
/// deviator to the cone. Without dilation the shear return keeps the mean stress.
template <int D>
inline Stress<D> returned(const DruckerPrager& cone, const Stress<D>& trial) {
    const double old_mean = mean(trial);
    const Stress<D> shear = deviator(trial, old_mean);
    // The least number keeps tau above 0 without a branch, which would keep loops from vectors.
    const double tau = std::sqrt(second_invariant(shear)) + std::numeric_limits<double>::min();
    const double new_mean = old_mean < cone.tension ? old_mean : cone.tension;
    const double strength = cone.cohesion - cone.friction * new_mean;
    return composed(new_mean, (strength < tau ? strength : tau) / tau, shear);
}

}  // namespace mpm
