#pragma once

#include "materials/material.hpp"
#include "particles/stress.hpp"

#include <array>
#include <vector>

namespace mpm {

/// Isotropic elastic moduli.
struct Elastic {
    double youngs_modulus = 0;  ///< Pa
    double poissons_ratio = 0;

    double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poissons_ratio)); }
    double shear_modulus() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }
    /// Returns the speed of pressure waves, m/s.
    double wave_speed(double density) const;
};

/// Returns the rules of density, youngs_modulus and poissons_ratio, followed by those of `more`.
std::vector<Rule> elastic_rules(const std::vector<Rule>& more = {});
Elastic elastic_of(const Values& values);
double elastic_wave_speed(const Values& values);

/// Returns a hypoelastic model with the Jaumann rate. Its only kernel rotates the stress of the
/// points and adds that of their strain.
template <int D>
MaterialModel<D> elastic_model(const Values& values, Particles& particles);

/// Returns the stress rotated with the material by the Jaumann rate.
///
/// The rotation is a rational function, like that of Hughes and Winget (1980), and preserves the
/// norm of the stress for any angle.
inline Stress<2> rotated(const Stress<2>& stress, const DisplacementGradient<2>& gradient) {
    const double angle = 0.5 * (gradient[0][1] - gradient[1][0]);
    const double mean = 0.5 * (stress.xx + stress.yy);
    const double half_difference = 0.5 * (stress.xx - stress.yy);
    const double scale = 1 / (1 + angle * angle);
    const double cosine = (1 - angle * angle) * scale;
    const double sine = 2 * angle * scale;
    const double turned = cosine * half_difference + sine * stress.xy;
    return {mean + turned, mean - turned, stress.zz, cosine * stress.xy - sine * half_difference};
}

using Matrix = std::array<std::array<double, 3>, 3>;

/// Returns the Cayley rotation (1 - W/2)^-1 (1 + W/2). W/2 is the skew matrix of the vector (x, y,
/// z), which is half the rotation vector of the step.
inline Matrix turn(double x, double y, double z) {
    const double square = x * x + y * y + z * z, scale = 2 / (1 + square);
    Matrix r;
    r[0] = {1 - scale * (y * y + z * z), scale * (x * y - z), scale * (x * z + y)};
    r[1] = {scale * (x * y + z), 1 - scale * (x * x + z * z), scale * (y * z - x)};
    r[2] = {scale * (x * z - y), scale * (y * z + x), 1 - scale * (x * x + y * y)};
    return r;
}

inline Stress<3> rotated(const Stress<3>& s, const DisplacementGradient<3>& gradient) {
    // Half the rotation vector is a quarter of the curl.
    const Matrix r =
        turn(0.25 * (gradient[2][1] - gradient[1][2]), 0.25 * (gradient[0][2] - gradient[2][0]),
             0.25 * (gradient[1][0] - gradient[0][1]));
    const Matrix old{{{s.xx, s.xy, s.zx}, {s.xy, s.yy, s.yz}, {s.zx, s.yz, s.zz}}};
    const auto entry = [&](std::size_t i, std::size_t j) {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k)
            sum += r[i][k] * (old[k][0] * r[j][0] + old[k][1] * r[j][1] + old[k][2] * r[j][2]);
        return sum;
    };
    return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)};
}

/// Adds the isotropic linear elastic stress of a small strain.
template <int D>
inline Stress<D> strained(Stress<D> stress, const DisplacementGradient<D>& gradient, double bulk,
                          double shear) {
    double volumetric = gradient[0][0] + gradient[1][1];
    if constexpr (D == 3) volumetric += gradient[2][2];
    const double pressure_part = (bulk - 2 * shear / 3) * volumetric;
    stress.xx = stress.xx + pressure_part + 2 * shear * gradient[0][0];
    stress.yy = stress.yy + pressure_part + 2 * shear * gradient[1][1];
    stress.zz = stress.zz + pressure_part;
    stress.xy += shear * (gradient[0][1] + gradient[1][0]);
    if constexpr (D == 3) {
        stress.zz += 2 * shear * gradient[2][2];
        stress.yz += shear * (gradient[1][2] + gradient[2][1]);
        stress.zx += shear * (gradient[2][0] + gradient[0][2]);
    }
    return stress;
}

}  // namespace mpm
