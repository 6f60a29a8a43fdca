#pragma once

#include <mpm/particles.hpp>

#include <array>
#include <cstddef>
#include <string>

namespace mpm {

/// Cauchy stress, Pa; tension is positive.
template <int D>
struct Stress;

/// Stress in plane strain.
template <>
struct Stress<2> {
    double xx = 0, yy = 0, zz = 0, xy = 0;
};

template <>
struct Stress<3> {
    double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
};

/// Gradient of the displacement in a step. Entry [i][j] is the derivative of component i along axis
/// j.
template <int D>
using DisplacementGradient = std::array<std::array<double, D>, D>;

/// Number of stress columns.
template <int D>
inline constexpr std::size_t num_stresses = D == 2 ? 4 : 6;

template <int D>
using StressColumns = std::array<Column, num_stresses<D>>;

/// Adds the columns stress_xx, stress_yy, stress_zz and stress_xy, and in three dimensions
/// stress_yz and stress_zx.
template <int D>
StressColumns<D> add_stress_columns(Particles& particles) {
    constexpr std::array<const char*, 6> names{"xx", "yy", "zz", "xy", "yz", "zx"};
    StressColumns<D> columns{};
    for (std::size_t c = 0; c < columns.size(); ++c)
        columns[c] = particles.add_column(std::string("stress_") + names[c]);
    return columns;
}

/// Pointers to the stress columns.
template <int D>
using StressPointers = std::array<double*, num_stresses<D>>;

template <int D>
StressPointers<D> stress_pointers(Particles& particles, const StressColumns<D>& columns) {
    StressPointers<D> pointers{};
    for (std::size_t c = 0; c < columns.size(); ++c) pointers[c] = particles.data(columns[c]);
    return pointers;
}

template <int D>
inline Stress<D> load(const StressPointers<D>& from, std::size_t p) {
    if constexpr (D == 2)
        return {from[0][p], from[1][p], from[2][p], from[3][p]};
    else
        return {from[0][p], from[1][p], from[2][p], from[3][p], from[4][p], from[5][p]};
}

template <int D>
inline void store(const Stress<D>& stress, const StressPointers<D>& to, std::size_t p) {
    to[0][p] = stress.xx;
    to[1][p] = stress.yy;
    to[2][p] = stress.zz;
    to[3][p] = stress.xy;
    if constexpr (D == 3) {
        to[4][p] = stress.yz;
        to[5][p] = stress.zx;
    }
}

template <int D>
inline double mean(const Stress<D>& stress) {
    return (stress.xx + stress.yy + stress.zz) / 3;
}

/// Returns J2, half the sum of the squares of a deviator.
template <int D>
inline double second_invariant(const Stress<D>& deviator) {
    const double diagonal =
        0.5 * (deviator.xx * deviator.xx + deviator.yy * deviator.yy + deviator.zz * deviator.zz);
    if constexpr (D == 2)
        return diagonal + deviator.xy * deviator.xy;
    else
        return diagonal +
               (deviator.xy * deviator.xy + deviator.yz * deviator.yz + deviator.zx * deviator.zx);
}

template <int D>
inline Stress<D> deviator(Stress<D> stress, double mean) {
    stress.xx -= mean;
    stress.yy -= mean;
    stress.zz -= mean;
    return stress;
}

/// Returns the stress mean + scale * deviator.
template <int D>
inline Stress<D> composed(double mean, double scale, const Stress<D>& deviator) {
    Stress<D> stress;
    stress.xx = mean + scale * deviator.xx;
    stress.yy = mean + scale * deviator.yy;
    stress.zz = mean + scale * deviator.zz;
    stress.xy = scale * deviator.xy;
    if constexpr (D == 3) {
        stress.yz = scale * deviator.yz;
        stress.zx = scale * deviator.zx;
    }
    return stress;
}

}  // namespace mpm
