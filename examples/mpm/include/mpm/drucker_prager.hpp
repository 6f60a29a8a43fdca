#pragma once

#include <mpm/elastic.hpp>

#include <cmath>
#include <limits>

namespace mpm {

/// Cone sqrt(J2) + friction * mean <= cohesion with mean <= tension; flows at constant volume.
struct DruckerPrager {
    double friction = 0;
    double cohesion = 0;  ///< Pa
    double tension = 0;   ///< Pa, at most the apex
};

/// The cone that fails in plane strain exactly where Mohr-Coulomb with no dilation does:
/// friction sin(phi), cohesion c cos(phi).
DruckerPrager matched_cone(const MohrCoulomb& strength);

/// The admissible stress a trial stress returns to.
///
/// Without dilation the shear return keeps the mean stress, so beyond the tension limit it ends
/// outside still, and both branches meet: the mean is cut to the limit, then the deviator to the
/// cone.
inline Stress returned(const DruckerPrager& cone, const Stress& trial) {
    const double mean = (trial.xx + trial.yy + trial.zz) / 3;
    const double xx = trial.xx - mean, yy = trial.yy - mean, zz = trial.zz - mean;
    const double tau = std::sqrt(0.5 * (xx * xx + yy * yy + zz * zz) + trial.xy * trial.xy);
    const double new_mean = mean < cone.tension ? mean : cone.tension;
    const double strength = cone.cohesion - cone.friction * new_mean;
    const double least = std::numeric_limits<double>::min();
    const double ratio = strength / (tau > least ? tau : least);
    const double scale = ratio < 1 ? ratio : 1;
    return {new_mean + scale * xx, new_mean + scale * yy, new_mean + scale * zz, scale * trial.xy};
}

}  // namespace mpm
