#pragma once

#include <rrcb/kokkos/device.hpp>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstdint>

namespace rrcb::detail {

/// Returns true if a number is neither NaN nor infinite.
KOKKOS_INLINE_FUNCTION bool is_finite(double value) {
    return value >= -DBL_MAX && value <= DBL_MAX;
}

/// A position in a kernel; 0 beyond the dimension.
struct Position {
    double x[max_dimension];
};

/// Coordinates in the memory of a device, at any stride.
template <class T>
struct Positions {
    const T* axes[max_dimension] = {};
    std::int64_t strides[max_dimension] = {};
    std::int64_t count = 0;
    int dimension = 0;
    bool are_even = true;  ///< all axes have `count` coordinates

    /// Returns a coordinate; -0 as 0, so that minima do not depend on an order.
    KOKKOS_INLINE_FUNCTION double operator()(std::int64_t i, int axis) const {
        return static_cast<double>(axes[axis][i * strides[axis]]) + 0.0;
    }
    KOKKOS_INLINE_FUNCTION Position position(std::int64_t i) const {
        Position p{};
        for (int a = 0; a < max_dimension; ++a)
            if (a < dimension) p.x[a] = (*this)(i, a);
        return p;
    }

    /// Adds an axis, from a view of its coordinates.
    template <class Axis>
    void add(const Axis& axis) {
        const auto length = static_cast<std::int64_t>(axis.extent(0));
        if (dimension == 0) count = length;
        are_even = are_even && length == count;
        axes[dimension] = axis.data();
        strides[dimension++] = static_cast<std::int64_t>(axis.stride(0));
    }
};

/// A view of points by axes.
template <class Points>
struct PointViews {
    using View = Points;

    static auto positions(const View& view) {
        Positions<typename View::non_const_value_type> x;
        const int dimension = static_cast<int>(view.extent(1));
        for (int a = 0; a < std::min(dimension, max_dimension); ++a)
            x.add(Kokkos::subview(view, Kokkos::ALL, a));
        x.dimension = dimension;
        return x;
    }
};

/// One view for each axis.
template <class Axis, std::size_t N>
struct PointViews<std::array<Axis, N>> {
    static_assert(N >= 1 && N <= max_dimension, "give a view for each of 1 to 3 axes");
    using View = Axis;

    static auto positions(const std::array<Axis, N>& views) {
        Positions<typename View::non_const_value_type> x;
        for (const Axis& axis : views) x.add(axis);
        return x;
    }
};

template <class Views>
using MemoryOf = typename PointViews<Views>::View::memory_space;
template <class Views>
using ScalarOf = typename PointViews<Views>::View::non_const_value_type;

/// Bits behind the point of sums of weights and first moments, and of second moments.
inline constexpr int weight_bits = 46;
inline constexpr int square_bits = 48;

/// Returns a number in units of 2^-bits.
KOKKOS_INLINE_FUNCTION std::int64_t to_units(double value, int bits) {
    const double units = value * static_cast<double>(std::int64_t{1} << bits);
    return static_cast<std::int64_t>(units + (units < 0 ? -0.5 : 0.5));
}

/// Weights in the memory of a device, relative to a power of two above the heaviest.
template <class W>
struct Weights {
    const W* values = nullptr;  ///< null: every point weighs 1
    std::int64_t stride = 0;
    int exponent = 0;  ///< of the power of two
    double scales[2] = {1, 1};

    void set_heaviest(double heaviest) {
        exponent = heaviest > 0 ? std::ilogb(heaviest) + 1 : 0;
        // In two factors, as the reciprocal of a tiny weight may overflow.
        scales[0] = std::ldexp(1.0, -(exponent / 2));
        scales[1] = std::ldexp(1.0, -(exponent - exponent / 2));
    }
    /// Returns a total in units of 2^-weight_bits as a weight.
    double from_units(double units) const { return std::ldexp(units, exponent - weight_bits); }

    KOKKOS_INLINE_FUNCTION double operator()(std::int64_t i) const {
        return values == nullptr ? 1.0 : static_cast<double>(values[i * stride]);
    }
    KOKKOS_INLINE_FUNCTION double relative(std::int64_t i) const {
        return (*this)(i)*scales[0] * scales[1];
    }
    KOKKOS_INLINE_FUNCTION std::int64_t units(std::int64_t i) const {
        return to_units(relative(i), weight_bits);
    }
};

}  // namespace rrcb::detail
