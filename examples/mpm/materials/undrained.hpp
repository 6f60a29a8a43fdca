#pragma once

#include "particles/stress.hpp"
#include "transfer/transfers.hpp"

#include <mpm/parameters.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpm {

/// Name of the column with the level of each point at the start, m, which determines its strength.
inline constexpr const char* start_level_column = "start_y";

/// The undrained shear strength of a clay. With the defaults the strength is constant.
struct UndrainedStrength {
    double at_surface = 0;      ///< strength at the surface, Pa
    double gradient = 0;        ///< increase per metre below the surface, Pa
    double surface = 0;         ///< level of the surface at the start, m
    double residual_ratio = 1;  ///< share of the strength that is left after large strains
    double softening_strain =
        1;  ///< plastic shear strain after which 95 % of the loss has occurred

    double intact(double level) const {
        return at_surface + gradient * std::max(surface - level, 0.0);
    }
    /// Returns the share of the strength left after a plastic shear strain (Einav and Randolph
    /// 2005).
    double softened(double plastic_strain) const {
        return residual_ratio +
               (1 - residual_ratio) * std::exp(-3 * plastic_strain / softening_strain);
    }
};

/// Returns the strength described by the parameters of a von_mises material.
inline UndrainedStrength undrained_of(const Values& values) {
    UndrainedStrength clay{.at_surface = values.number("strength"),
                           .gradient = values.number("strength_gradient"),
                           .surface = values.number("surface")};
    if (values.has("residual_ratio")) {
        clay.residual_ratio = values.number("residual_ratio");
        clay.softening_strain = values.number("softening_strain");
    }
    return clay;
}

/// Returns a trial stress to von Mises' condition sqrt(J2) <= strength. Clay that flows in plane
/// strain then satisfies Tresca's condition as well.
template <int D>
inline Stress<D> returned(double strength, const Stress<D>& trial) {
    const double pressure = mean(trial);
    const Stress<D> shear = deviator(trial, pressure);
    const double tau =
        std::max(std::sqrt(second_invariant(shear)), std::numeric_limits<double>::min());
    return composed(pressure, std::min(strength, tau) / tau, shear);
}

}  // namespace mpm
