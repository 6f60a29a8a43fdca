#pragma once

#include "particles/stress.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpm {

/// Soil that flows: shear stress yield_stress + consistency * rate^exponent; Bingham's for 1.
struct HerschelBulkley {
    double yield_stress = 0;  ///< Pa
    double consistency = 0;   ///< Pa s^exponent
    double exponent = 1;
};

/// Rate of viscous shear over a step, 1/s, of a trial stress by `excess` above the yield stress,
/// Pa.
///
/// It solves stiffness * rate + consistency * rate^exponent = excess, where stiffness is shear
/// modulus * time step.
///
/// Newton's method starts above the solution. The unknown is the rate, or the viscous stress where
/// the exponent is below 1: so the function is convex, and the iterates descend without
/// overshooting.
inline double viscous_rate(const HerschelBulkley& fluid, double stiffness, double excess) {
    constexpr int most_iterations = 60;
    if (!(excess > 0)) return 0;
    if (!(fluid.consistency > 0)) return excess / stiffness;
    if (fluid.exponent == 1) return excess / (stiffness + fluid.consistency);
    // unknown + factor * unknown^power = right
    const bool is_rate = fluid.exponent > 1;
    const double power = is_rate ? fluid.exponent : 1 / fluid.exponent;
    const double factor = is_rate ? fluid.consistency / stiffness
                                  : stiffness * std::pow(1 / fluid.consistency, power);
    const double right = is_rate ? excess / stiffness : excess;
    double unknown = std::min(right, std::pow(right / factor, 1 / power));
    for (int k = 0; k < most_iterations; ++k) {
        const double term = factor * std::pow(unknown, power);
        const double change = (unknown + term - right) / (1 + power * term / unknown);
        unknown -= change;
        if (!(change > std::numeric_limits<double>::epsilon() * unknown)) break;
    }
    return is_rate ? unknown : std::pow(unknown / fluid.consistency, power);
}

/// Stress after a step from an elastic trial stress; its mean stays.
template <int D>
inline Stress<D> returned(const HerschelBulkley& fluid, double stiffness, const Stress<D>& trial) {
    const double pressure = mean(trial);
    const Stress<D> shear = deviator(trial, pressure);
    const double tau = std::sqrt(second_invariant(shear));
    const double rate = viscous_rate(fluid, stiffness, tau - fluid.yield_stress);
    if (!(rate > 0)) return trial;
    return composed(pressure, std::max(1 - stiffness * rate / tau, 0.0), shear);
}

}  // namespace mpm
