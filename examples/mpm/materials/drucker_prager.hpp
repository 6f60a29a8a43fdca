#pragma once

#include "materials/elastic.hpp"

#include <cmath>
#include <limits>

namespace mpm {

/// The cone sqrt(J2) + friction * mean stress <= cohesion, with mean stress <= tension.
struct DruckerPrager {
    double friction = 0;
    double cohesion = 0;  ///< Pa
    double tension = 0;   ///< Pa; at most the mean stress at the apex
};

/// Returns the cone that in plane strain fails at the same stresses as Mohr-Coulomb without
/// dilation. Its friction is sin(phi), its cohesion c cos(phi). The angle phi is in degrees;
/// `tension_cut_off` bounds the mean stress.
DruckerPrager matched_cone(double cohesion, double friction_angle, double tension_cut_off);

/// Returns the admissible stress for a trial stress. First the mean stress is cut to the tension
/// limit, then the deviator to the cone. Because there is no dilation, the second step keeps the
/// mean stress.
template <int D>
inline Stress<D> returned(const DruckerPrager& cone, const Stress<D>& trial) {
    const double old_mean = mean(trial);
    const Stress<D> shear = deviator(trial, old_mean);
    // Adding the smallest number keeps tau above 0. A branch would prevent vectorization.
    const double tau = std::sqrt(second_invariant(shear)) + std::numeric_limits<double>::min();
    const double new_mean = old_mean < cone.tension ? old_mean : cone.tension;
    const double strength = cone.cohesion - cone.friction * new_mean;
    return composed(new_mean, (strength < tau ? strength : tau) / tau, shear);
}

}  // namespace mpm
