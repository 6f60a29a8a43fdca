#pragma once

#include <mpm/elastic.hpp>

#include <cmath>
#include <limits>

namespace mpm {

/// Strength in terms of Mohr-Coulomb.
struct MohrCoulomb {
    double cohesion = 0;         ///< Pa
    double friction_angle = 0;   ///< degrees
    double tension_cut_off = 0;  ///< Pa, mean stress; the cone's apex where that is less
};

/// Cone sqrt(J2) + friction * mean <= cohesion with mean <= tension; flows at constant volume.
struct DruckerPrager {
    double friction = 0;
    double cohesion = 0;  ///< Pa
    double tension = 0;   ///< Pa, at most the apex
};

/// The cone that fails in plane strain exactly where Mohr-Coulomb with no dilation does:
/// friction sin(phi), cohesion c cos(phi).
DruckerPrager matched_cone(const MohrCoulomb& strength);

/// The cone inside Mohr-Coulomb's pyramid, through the edges of triaxial extension:
/// friction 6 sin(phi) / (sqrt(3) (3 + sin(phi))), cohesion likewise with c cos(phi).
DruckerPrager inner_cone(const MohrCoulomb& strength);

/// The admissible stress a trial stress returns to.
///
/// Without dilation the shear return keeps the mean stress, so beyond the tension limit it ends
/// outside still, and both branches meet: the mean is cut to the limit, then the deviator to the
/// cone.
template <int D>
inline Stress<D> returned(const DruckerPrager& cone, const Stress<D>& trial) {
    const double old_mean = mean(trial);
    const Stress<D> shear = deviator(trial, old_mean);
    // Never 0, and written so that a loop over points has no branch.
    const double tau = std::sqrt(second_invariant(shear)) + std::numeric_limits<double>::min();
    const double new_mean = old_mean < cone.tension ? old_mean : cone.tension;
    const double strength = cone.cohesion - cone.friction * new_mean;
    return composed(new_mean, (strength < tau ? strength : tau) / tau, shear);
}

}  // namespace mpm
