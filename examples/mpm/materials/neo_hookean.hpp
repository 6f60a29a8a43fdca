#pragma once

#include "materials/elastic.hpp"

#include <cmath>

namespace mpm {

/// Deformation gradient. In plane strain its third row and column are those of the unit matrix.
template <int D>
using Deformation = std::array<std::array<double, D>, D>;

template <int D>
inline double determinant(const Deformation<D>& f) {
    if constexpr (D == 2)
        return f[0][0] * f[1][1] - f[0][1] * f[1][0];
    else
        return f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) -
               f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0]) +
               f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
}

/// Deformation gradient after a step, (1 + gradient) F.
template <int D>
inline Deformation<D> deformed(const Deformation<D>& f, const DisplacementGradient<D>& gradient) {
    Deformation<D> next = f;
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = 0; j < D; ++j)
            for (std::size_t k = 0; k < D; ++k) next[i][j] += gradient[i][k] * f[k][j];
    return next;
}

/// Entry i, j of F F^T.
template <int D>
inline double left_cauchy_green(const Deformation<D>& f, std::size_t i, std::size_t j) {
    double sum = 0;
    for (std::size_t k = 0; k < D; ++k) sum += f[i][k] * f[j][k];
    return sum;
}

/// Cauchy stress (G (b - 1) + lambda ln J 1) / J of a compressible neo-Hookean solid (Simo and
/// Pister 1984).
template <int D>
inline Stress<D> neo_hookean_stress(const Elastic& elastic, const Deformation<D>& f) {
    const double shear = elastic.shear_modulus();
    const double lambda = elastic.bulk_modulus() - 2 * shear / 3;
    const double j = determinant<D>(f), pressure_part = lambda * std::log(j) / j;
    const auto along = [&](std::size_t i) {
        return shear * (left_cauchy_green<D>(f, i, i) - 1) / j + pressure_part;
    };
    Stress<D> stress;
    stress.xx = along(0);
    stress.yy = along(1);
    stress.zz = pressure_part;
    stress.xy = shear * left_cauchy_green<D>(f, 0, 1) / j;
    if constexpr (D == 3) {
        stress.zz = along(2);
        stress.yz = shear * left_cauchy_green<D>(f, 1, 2) / j;
        stress.zx = shear * left_cauchy_green<D>(f, 2, 0) / j;
    }
    return stress;
}

/// Stored energy per volume at the start, G (tr b - D) / 2 - G ln J + lambda (ln J)^2 / 2.
template <int D>
inline double neo_hookean_energy(const Elastic& elastic, const Deformation<D>& f) {
    const double shear = elastic.shear_modulus();
    const double lambda = elastic.bulk_modulus() - 2 * shear / 3;
    const double log_j = std::log(determinant<D>(f));
    double trace = 0;
    for (std::size_t i = 0; i < D; ++i) trace += left_cauchy_green<D>(f, i, i);
    return 0.5 * shear * (trace - D) - shear * log_j + 0.5 * lambda * log_j * log_j;
}

}  // namespace mpm
