#pragma once

#include <mpm/particles.hpp>
#include <mpm/scene.hpp>

namespace mpm {

/// Cauchy stress in plane strain, Pa, tension positive.
struct Stress {
    double xx = 0, yy = 0, zz = 0, xy = 0;
};

struct StressColumns {
    Column xx, yy, zz, xy;
};

StressColumns add_stress_columns(Particles& particles);

/// Velocity gradient times time step; xy is the derivative of the x-displacement along y.
struct DisplacementGradient {
    double xx = 0, xy = 0, yx = 0, yy = 0;
};

/// Stress turned with the material: the Jaumann rate, integrated so that its norm is kept
/// whatever the angle (Hughes and Winget 1980).
inline Stress rotated(const Stress& stress, const DisplacementGradient& gradient) {
    const double angle = 0.5 * (gradient.xy - gradient.yx);
    const double mean = 0.5 * (stress.xx + stress.yy);
    const double half_difference = 0.5 * (stress.xx - stress.yy);
    const double scale = 1 / (1 + angle * angle);
    const double cosine = (1 - angle * angle) * scale;
    const double sine = 2 * angle * scale;
    const double turned = cosine * half_difference + sine * stress.xy;
    return {mean + turned, mean - turned, stress.zz, cosine * stress.xy - sine * half_difference};
}

/// Adds the stress of a small strain: isotropic, linear.
inline Stress strained(const Stress& stress, const DisplacementGradient& gradient, double bulk,
                       double shear) {
    const double volumetric = gradient.xx + gradient.yy;
    const double pressure_part = (bulk - 2 * shear / 3) * volumetric;
    return {stress.xx + pressure_part + 2 * shear * gradient.xx,
            stress.yy + pressure_part + 2 * shear * gradient.yy, stress.zz + pressure_part,
            stress.xy + shear * (gradient.xy + gradient.yx)};
}

}  // namespace mpm
