#pragma once

#include <mpm/stress.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpm {

/// Undrained shear strength of a clay; what is left at its default is not asked for.
struct UndrainedStrength {
    double at_surface = 0;        ///< Pa
    double gradient = 0;          ///< Pa per metre below the surface
    double surface = 0;           ///< level of the surface at the start, m
    double residual_ratio = 1;    ///< of the strength after large strains
    double softening_strain = 1;  ///< plastic shear strain at which 95 % of the loss is there
    double rate_factor = 0;       ///< gain per tenfold rate
    double reference_rate = 1;    ///< shear strain rate below which there is no gain, 1/s

    double intact(double level) const {
        return at_surface + gradient * std::max(surface - level, 0.0);
    }
    /// Share left after a plastic shear strain (Einav and Randolph 2005).
    double softened(double plastic_strain) const {
        return residual_ratio +
               (1 - residual_ratio) * std::exp(-3 * plastic_strain / softening_strain);
    }
    double quickened(double rate) const {
        return 1 + rate_factor * std::log10(std::max(rate / reference_rate, 1.0));
    }
};

/// The stress a trial stress returns to on sqrt(J2) <= strength: von Mises, and in plane strain
/// without dilation Tresca as well.
template <int D>
inline Stress<D> returned(double strength, const Stress<D>& trial) {
    const double pressure = mean(trial);
    const Stress<D> shear = deviator(trial, pressure);
    const double tau = std::sqrt(second_invariant(shear));
    const double ratio = strength / std::max(tau, std::numeric_limits<double>::min());
    return composed(pressure, std::min(ratio, 1.0), shear);
}

}  // namespace mpm
