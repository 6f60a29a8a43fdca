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

/// The axes of positions that are one view of points by axes.
template <class Views>
struct Axes {
    static constexpr std::size_t number = Views::static_extent(1);  ///< 0 if known at run time

    static std::size_t number_of(const Views& x) { return x.extent(1); }
    static std::size_t length_of(const Views& x, std::size_t) { return x.extent(0); }
    static auto view_of(const Views& x, int axis) { return Kokkos::subview(x, Kokkos::ALL, axis); }
};

/// The axes of positions that are an array with a view for each axis.
template <class View, std::size_t N>
struct Axes<std::array<View, N>> {
    static constexpr std::size_t number = N;

    static std::size_t number_of(const auto&) { return N; }
    static std::size_t length_of(const auto& x, std::size_t axis) { return x[axis].extent(0); }
    static View view_of(const auto& x, std::size_t axis) { return x[axis]; }
};

/// The view of one axis.
template <class Views>
using AxisOf = decltype(Axes<Views>::view_of(std::declval<Views>(), 0));
template <class Views>
using MemoryOf = typename AxisOf<Views>::memory_space;
template <class View>
concept KokkosView = Kokkos::is_view<View>::value;
template <class Views>
concept KokkosPoints = KokkosView<AxisOf<Views>>;

/// Positions in the memory of a device, with a dimension that is a compile-time constant. Their
/// stride is 1 if `IsUnit`.
template <class T, int Dimension, bool IsUnit>
struct Positions {
    static constexpr int dimension = Dimension;

    const T* values[Dimension];
    std::int64_t strides[Dimension];
    std::int64_t count;

    /// Returns a coordinate. Converts -0 to 0, so that minima do not depend on the order.
    KOKKOS_INLINE_FUNCTION double operator()(std::int64_t i, int axis) const {
        return values[axis][IsUnit ? i : i * strides[axis]] + 0.0;
    }
};

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
    const W* values;
    std::int64_t stride;
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

    KOKKOS_INLINE_FUNCTION double operator()(std::int64_t i) const { return values[i * stride]; }
    KOKKOS_INLINE_FUNCTION double relative(std::int64_t i) const {
        return (*this)(i)*scales[0] * scales[1];
    }
    KOKKOS_INLINE_FUNCTION std::int64_t units(std::int64_t i) const {
        return to_units(relative(i), weight_bits);
    }
};

/// Bounds of the coordinates and weights, and which points are at the bounds of coordinates. Of
/// several such points it is the first or the last in the order of the other axes.
template <int Dimension>
struct Ends {
    double bounds[2 * Dimension];        ///< least on each axis, then greatest on each axis
    std::int64_t points[2 * Dimension];  ///< at each bound
    double lightest;
    double heaviest;
    std::int64_t faults;
};

/// Finds the ends of all points. Reads weights if they count, and positions if asked to.
template <class Positions, class W, bool Weighs>
struct FindEnds {
    static constexpr int dimension = Positions::dimension;
    using value_type = Ends<dimension>;

    Positions x;
    Weights<W> weights;
    bool reads_positions;

    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, value_type& ends) const {
        if constexpr (Weighs) {
            const double weight = weights(i);
            ends.faults += !(weight >= 0 && is_finite(weight));
            widen(weight, weight, ends);
        }
        if (!reads_positions) return;
        for (int a = 0; a < dimension; ++a) {
            const double value = x(i, a);
            ends.faults += !is_finite(value);
            widen(a, value, i, ends);
            widen(dimension + a, value, i, ends);
        }
    }
    KOKKOS_INLINE_FUNCTION void init(value_type& ends) const {
        ends = {{}, {}, HUGE_VAL, 0, 0};
        for (int k = 0; k < 2 * dimension; ++k)
            ends.bounds[k] = k < dimension ? HUGE_VAL : -HUGE_VAL;
    }
    KOKKOS_INLINE_FUNCTION void join(value_type& ends, const value_type& others) const {
        widen(others.lightest, others.heaviest, ends);
        for (int k = 0; k < 2 * dimension; ++k) widen(k, others.bounds[k], others.points[k], ends);
        ends.faults += others.faults;
    }
    // Needed by Kokkos before 3.7, which joins volatile values.
    KOKKOS_INLINE_FUNCTION void join(volatile value_type& ends,
                                     const volatile value_type& others) const {
        join(const_cast<value_type&>(ends), const_cast<const value_type&>(others));
    }

  private:
    KOKKOS_INLINE_FUNCTION static void widen(double lightest, double heaviest, value_type& ends) {
        if (lightest < ends.lightest) ends.lightest = lightest;
        if (heaviest > ends.heaviest) ends.heaviest = heaviest;
    }
    KOKKOS_INLINE_FUNCTION void widen(int k, double value, std::int64_t i, value_type& ends) const {
        bool is_beyond = k < dimension ? value < ends.bounds[k] : value > ends.bounds[k];
        if (value == ends.bounds[k])
            is_beyond = k < dimension ? is_before(i, ends.points[k]) : is_before(ends.points[k], i);
        if (is_beyond) ends.bounds[k] = value;
        if (is_beyond) ends.points[k] = i;
    }
    /// Compares two points along the axes in ascending order.
    KOKKOS_INLINE_FUNCTION bool is_before(std::int64_t i, std::int64_t j) const {
        for (int a = 0; a < dimension; ++a)
            if (x(i, a) != x(j, a)) return x(i, a) < x(j, a);
        return false;
    }
};

/// Returns the ends of the weights and, if `reads_positions`, of the positions. Ends with a fence.
template <bool Weighs, class Device, class Positions, class W>
Ends<Positions::dimension> find_ends(const Device& device, const Positions& x,
                                     const Weights<W>& weights, bool reads_positions) {
    Ends<Positions::dimension> ends;
    const auto lock = lock_scratch<typename Device::Execution>();
    Kokkos::parallel_reduce("rrcb::find_ends", device.range(x.count),
                            FindEnds<Positions, W, Weighs>{x, weights, reads_positions}, ends);
    return ends;
}

}  // namespace rrcb::detail
