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

/// Coordinates in the memory of a device. Their stride is 1 if `IsUnit`, otherwise any. A dimension
/// of 0 means that it is known only at run time; see with_dimension().
template <class T, int Dimension, bool IsUnit>
struct Positions {
    static constexpr int static_dimension = Dimension;

    const T* axes[max_dimension] = {};
    std::int64_t strides[max_dimension] = {};
    std::int64_t count = 0;
    int dimension = Dimension;
    bool are_even = true;  ///< whether all axes have `count` coordinates

    /// Returns a coordinate. Converts -0 to 0, so that minima do not depend on the order.
    KOKKOS_INLINE_FUNCTION double operator()(std::int64_t i, int axis) const {
        return static_cast<double>(axes[axis][IsUnit ? i : i * strides[axis]]) + 0.0;
    }
    KOKKOS_INLINE_FUNCTION Position<Dimension> position(std::int64_t i) const {
        Position<Dimension> p;
        for (int a = 0; a < Dimension; ++a) p.x[a] = (*this)(i, a);
        return p;
    }
};

template <class Positions>
inline constexpr int dimension_of = std::remove_cvref_t<Positions>::static_dimension;

/// Calls call(x) with positions whose dimension is a compile-time constant.
template <class T, bool IsUnit, int Dimension, class Call>
auto with_dimension(const Positions<T, Dimension, IsUnit>& x, const Call& call) {
    if constexpr (Dimension > 0) {
        return call(x);
    } else {
        const auto fixed = [&]<int D>() {
            Positions<T, D, IsUnit> same{.count = x.count};
            std::copy_n(x.axes, D, same.axes);
            std::copy_n(x.strides, D, same.strides);
            return same;
        };
        if (x.dimension == 1) return call(fixed.template operator()<1>());
        if (x.dimension == 2) return call(fixed.template operator()<2>());
        return call(fixed.template operator()<3>());
    }
}

/// Type of the views of positions: one view of points by axes, or an array with a view for each
/// axis.
template <class Views>
struct ViewOf {
    using Type = Views;
    static constexpr auto dimension = static_cast<int>(Views::static_extent(1));
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
auto positions_of(const Views& views) {
    Positions<ScalarOf<Views>, ViewOf<Views>::dimension, ViewOf<Views>::is_unit> x;
    const auto add = [&x](int a, const auto& axis) {
        const auto length = static_cast<std::int64_t>(axis.extent(0));
        if (a == 0) x.count = length;
        x.are_even = x.are_even && length == x.count;
        x.axes[a] = axis.data();
        x.strides[a] = static_cast<std::int64_t>(axis.stride(0));
    };
    if constexpr (Kokkos::is_view<Views>::value) x.dimension = static_cast<int>(views.extent(1));
    for (int a = 0; a < std::min(x.dimension, max_dimension); ++a)
        if constexpr (Kokkos::is_view<Views>::value)
            add(a, Kokkos::subview(views, Kokkos::ALL, a));
        else
            add(a, views[static_cast<std::size_t>(a)]);
    return x;
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
    int exponent = 0;  ///< exponent of the power of two
    double scales[2] = {1, 1};

    void set_heaviest(double heaviest) {
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

/// Number of illegal values, and the first of them.
struct Faults {
    std::int64_t count;
    std::int64_t first;  ///< least value of 4 i + axis, for point i

    KOKKOS_INLINE_FUNCTION void add(const Faults& others) {
        count += others.count;
        if (others.first < first) first = others.first;
    }
    std::string point() const { return std::to_string(first / 4); }
    std::string tally() const {
        return " (" + std::to_string(count) + (count == 1 ? " such value" : " such values") +
               " on this rank)";
    }
};

}  // namespace rrcb::detail
