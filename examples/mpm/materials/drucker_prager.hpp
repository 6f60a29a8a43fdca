#pragma once

#include "materials/elastic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpm {

/// Strength in the terms of Mohr-Coulomb.
struct MohrCoulomb {
    double cohesion = 0;         ///< Pa
    double friction_angle = 0;   ///< degrees
    double tension_cut_off = 0;  ///< Pa, mean stress; the cone's apex where that is less
    double dilation_angle = 0;   ///< degrees, at most the friction angle
};

/// Cone sqrt(J2) + friction * mean <= cohesion with mean <= tension.
struct DruckerPrager {
    double friction = 0;
    double cohesion = 0;  ///< Pa
    double tension = 0;   ///< Pa, at most the apex
    double dilation = 0;  ///< plastic volume by plastic strain along sqrt(J2)
};

/// The cone that fails in plane strain exactly where Mohr-Coulomb with the same dilation does.
///
/// Without dilation, psi = 0, friction is sin(phi) and cohesion c cos(phi). With it both are
/// divided by sqrt(1 - q^2 / 3) + q sin(phi) / 3, where q = sin(psi) / sqrt(1 + sin(psi)^2 / 3) is
/// the dilation. That follows from no plastic strain out of the plane. With psi = phi it is Drucker
/// and Prager's own match (1952), 3 tan(phi) / sqrt(9 + 12 tan(phi)^2).
DruckerPrager matched_cone(const MohrCoulomb& strength);

/// The cone inside Mohr-Coulomb's pyramid, through the edges of triaxial extension:
/// friction 6 sin(phi) / (sqrt(3) (3 + sin(phi))), cohesion likewise with c cos(phi), dilation
/// with psi.
DruckerPrager inner_cone(const MohrCoulomb& strength);

/// The cone around the pyramid, through the edges of triaxial compression: the same with
/// 3 - sin(phi). It is stronger than Mohr-Coulomb anywhere else.
DruckerPrager outer_cone(const MohrCoulomb& strength);

/// Admissible stress that a trial stress returns to where dilation is 0.
///
/// The shear return then keeps the mean stress. Beyond the tension limit it would end outside, so
/// both returns follow each other: the mean is cut to the limit, then the deviator to the cone.
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

/// Admissible stress that a trial stress returns to where there is dilation: along the flow to the
/// cone, or to the tension limit.
///
/// The bisector of their edge decides between both (FLAC's theory manual, Drucker-Prager model).
template <int D>
inline Stress<D> returned(const DruckerPrager& cone, double bulk, double shear,
                          const Stress<D>& trial) {
    const double old_mean = mean(trial);
    const Stress<D> s = deviator(trial, old_mean);
    const double tau = std::sqrt(second_invariant(s));
    const double excess = tau + cone.friction * old_mean - cone.cohesion;
    const double at_limit = cone.cohesion - cone.friction * cone.tension;
    const double steepness = std::sqrt(1 + cone.friction * cone.friction) - cone.friction;
    const bool shears = excess > 0 && (old_mean < cone.tension ||
                                       tau - at_limit > steepness * (old_mean - cone.tension));
    double new_mean = old_mean;
    if (shears)
        new_mean -= bulk * cone.dilation * excess / (shear + bulk * cone.friction * cone.dilation);
    new_mean = std::min(new_mean, cone.tension);
    const double strength = cone.cohesion - cone.friction * new_mean;
    return composed(new_mean, tau > strength ? strength / tau : 1, s);
}

}  // namespace mpm
