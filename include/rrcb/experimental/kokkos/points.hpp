#pragma once

#include <rrcb/experimental/kokkos/device.hpp>

#include <array>
#include <cfloat>
#include <cmath>

namespace rrcb::detail {

/// Returns true if a number is neither NaN nor infinite.
KOKKOS_INLINE_FUNCTION bool is_finite(double value) {
    return value >= -DBL_MAX && value <= DBL_MAX;
}

/// A position in a kernel.
template <int Dimension>
struct Position {
    double x[Dimension];
};

/// Coordinates in the memory of a device, at any stride.
template <class T>
struct Axes {
    const T* values[max_dimension] = {};
    std::int64_t strides[max_dimension] = {};
    std::int64_t count = 0;
    int dimension = 0;
    bool are_even = true;  ///< whether all axes have `count` coordinates
};

/// Coordinates with a dimension that is a compile-time constant. Their stride is 1 if `IsUnit`.
template <class T, int Dimension, bool IsUnit>
struct Positions : Axes<T> {
    static constexpr int static_dimension = Dimension;

    /// Returns a coordinate. Converts -0 to 0, so that minima do not depend on the order.
    KOKKOS_INLINE_FUNCTION double operator()(std::int64_t i, int axis) const {
        return static_cast<double>(this->values[axis][IsUnit ? i : i * this->strides[axis]]) + 0.0;
    }
    KOKKOS_INLINE_FUNCTION Position<Dimension> position(std::int64_t i) const {
        Position<Dimension> p;
        for (int a = 0; a < Dimension; ++a) p.x[a] = (*this)(i, a);
        return p;
    }
};

/// Type of the views of positions: one view of points by axes, or an array with a view for each
/// axis.
template <class Views>
struct ViewOf {
    using Type = Views;
    static constexpr auto dimension =
        static_cast<int>(Views::static_extent(1));  // 0 if it is known at run time
    static_assert(dimension <= max_dimension, "positions have 1 to 3 axes");
    static constexpr bool is_unit =
        std::is_same_v<typename Views::array_layout, Kokkos::LayoutLeft>;
};
template <class Axis, std::size_t N>
struct ViewOf<std::array<Axis, N>> {
    static_assert(N >= 1 && N <= max_dimension, "positions have 1 to 3 axes");
    using Type = Axis;
    static constexpr auto dimension = static_cast<int>(N);
    static constexpr bool is_unit =
        !std::is_same_v<typename Axis::array_layout, Kokkos::LayoutStride>;
};
template <class Views>
using MemoryOf = typename ViewOf<Views>::Type::memory_space;
template <class Views>
using ScalarOf = typename ViewOf<Views>::Type::non_const_value_type;

template <class Views>
Axes<ScalarOf<Views>> axes_of(const Views& views) {
    Axes<ScalarOf<Views>> axes;
    const auto add = [&axes](const auto* values, std::size_t stride) {
        if (axes.dimension < max_dimension) {
            axes.values[axes.dimension] = values;
            axes.strides[axes.dimension] = static_cast<std::int64_t>(stride);
        }
        ++axes.dimension;
    };
    if constexpr (Kokkos::is_view<Views>::value) {
        axes.count = static_cast<std::int64_t>(views.extent(0));
        for (std::size_t a = 0; a < views.extent(1); ++a)
            add(views.data() + a * views.stride(1), views.stride(0));
    } else {
        axes.count = static_cast<std::int64_t>(views[0].extent(0));
        for (const auto& axis : views) {
            axes.are_even = axes.are_even && axis.extent(0) == views[0].extent(0);
            add(axis.data(), axis.stride(0));
        }
    }
    return axes;
}

/// Calls call(x) with positions whose dimension is a compile-time constant.
template <class Views, int Dimension = ViewOf<Views>::dimension, class Call>
auto with_positions(const Axes<ScalarOf<Views>>& axes, const Call& call) {
    if constexpr (Dimension > 0)
        return call(Positions<ScalarOf<Views>, Dimension, ViewOf<Views>::is_unit>{axes});
    else if (axes.dimension == 1)
        return with_positions<Views, 1>(axes, call);
    else if (axes.dimension == 2)
        return with_positions<Views, 2>(axes, call);
    else
        return with_positions<Views, 3>(axes, call);
}

/// Number of binary digits after the point: in sums of weights and first moments, and in second
/// moments.
inline constexpr int weight_bits = 46;
inline constexpr int square_bits = 48;

/// Returns a number, whose size must be below 2^51 units, in units of 2^-bits.
KOKKOS_INLINE_FUNCTION std::int64_t to_units(double value, int bits) {
    // Adding 1.5 * 2^52 rounds the number to an integer.
    constexpr double shift = 0x1.8p52;
    const double units = value * static_cast<double>(std::int64_t{1} << bits);
    return static_cast<std::int64_t>(units + shift - shift);
}

/// Weights in the memory of a device, divided by a power of two above the heaviest.
template <class W>
struct Weights {
    const W* values = nullptr;  ///< null if every point weighs 1
    std::int64_t stride = 0;
    double heaviest = -1;  ///< heaviest weight; -1 if it is not known
    int exponent = 0;      ///< exponent of the power of two
    double scales[2] = {1, 1};

    void set_heaviest(double weight) {
        heaviest = weight;
        exponent = heaviest > 0 ? std::ilogb(heaviest) + 1 : 0;
        // The scale has two factors, because the reciprocal of a tiny weight may overflow.
        scales[0] = std::ldexp(1.0, -(exponent / 2));
        scales[1] = std::ldexp(1.0, -(exponent - exponent / 2));
    }
    /// Converts a sum in units of 2^-weight_bits to a weight.
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
