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
        1;                      ///< plastic shear strain after which 95 % of the loss has occurred
    double rate_factor = 0;     ///< relative gain for each tenfold increase of the strain rate
    double reference_rate = 1;  ///< shear strain rate below which there is no gain, 1/s

    double intact(double level) const {
        return at_surface + gradient * std::max(surface - level, 0.0);
    }
    /// Returns the share of the strength left after a plastic shear strain (Einav and Randolph
    /// 2005).
    double softened(double plastic_strain) const {
        return residual_ratio +
               (1 - residual_ratio) * std::exp(-3 * plastic_strain / softening_strain);
    }
    double quickened(double rate) const {
        return 1 + rate_factor * std::log10(std::max(rate / reference_rate, 1.0));
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
    if (values.has("rate_factor")) {
        clay.rate_factor = values.number("rate_factor");
        clay.reference_rate = values.number("reference_rate");
    }
    return clay;
}

/// Returns the rate of engineering shear strain of point `k` of a block, 1/s. It is 2 sqrt(J2) of
/// the deviator of the rate of deformation.
template <int D>
double shear_rate(const PointBlock<D>& block, std::size_t k) {
    double volumetric = 0, square = 0;
    for (std::size_t i = 0; i < D; ++i) volumetric += block.gradient(i, i)[k];
    for (std::size_t i = 0; i < 3; ++i) {
        const double along = (i < D ? block.gradient(i, i)[k] : 0) - volumetric / 3;
        square += 0.5 * along * along;
    }
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = i + 1; j < D; ++j) {
            const double half = 0.5 * (block.gradient(i, j)[k] + block.gradient(j, i)[k]);
            square += half * half;
        }
    return 2 * std::sqrt(square);
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
