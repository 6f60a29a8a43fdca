#pragma once

#include <rrcb/kokkos/memory.hpp>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>

namespace rrcb::detail {

/// Integers that atomic operations of all devices add; negative numbers wrap.
using Word = unsigned long long;

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
};

template <class View>
using ScalarOf = typename View::non_const_value_type;

/// Returns the positions of a view of points by axes, or of the only axis.
template <class View>
auto positions_of(const View& view) {
    Positions<ScalarOf<View>> x;
    x.count = static_cast<std::int64_t>(view.extent(0));
    if constexpr (static_cast<int>(View::rank) == 1) {
        return positions_of(std::array<View, 1>{view});
    } else {
        x.dimension = static_cast<int>(view.extent(1));
        for (int a = 0; a < std::min(x.dimension, max_dimension); ++a) {
            x.axes[a] = view.data() + a * static_cast<std::int64_t>(view.stride(1));
            x.strides[a] = static_cast<std::int64_t>(view.stride(0));
        }
        return x;
    }
}

/// Returns the positions of one view for each axis.
template <class View, std::size_t N>
auto positions_of(const std::array<View, N>& views) {
    static_assert(N >= 1 && N <= max_dimension, "give a view for each of 1 to 3 axes");
    Positions<ScalarOf<View>> x;
    x.count = static_cast<std::int64_t>(views[0].extent(0));
    x.dimension = static_cast<int>(N);
    for (std::size_t a = 0; a < N; ++a) {
        x.axes[a] = views[a].data();
        x.strides[a] = static_cast<std::int64_t>(views[a].stride(0));
        x.are_even = x.are_even && views[a].extent(0) == views[0].extent(0);
    }
    return x;
}

/// Bits behind the point of sums of weights, first and second moments. A block of points holds
/// `block_length` numbers up to 1, 1/2 and 1/4.
inline constexpr int weight_bits = 46;
inline constexpr int square_bits = 48;
inline constexpr int block_length = 1 << 15;

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

/// Returns the weights of a view; none of an empty one.
template <class View>
auto weights_of(const View& view) {
    Weights<ScalarOf<View>> weights;
    if (view.extent(0) == 0) return weights;
    weights.values = view.data();
    weights.stride = static_cast<std::int64_t>(view.stride(0));
    return weights;
}

/// Number of values that cannot be used, and the first of them. Starts as zeros.
struct Faults {
    Word places;  ///< 4 i + axis of the first, inverted; 0: none
    Word count;

    KOKKOS_INLINE_FUNCTION void add(std::int64_t i, int axis) {
        Kokkos::atomic_fetch_max(&places, ~static_cast<Word>(4 * i + axis));
        Kokkos::atomic_fetch_add(&count, Word{1});
    }
    std::string place() const { return std::to_string(~places / 4); }
    std::string axis() const { return std::to_string(~places % 4); }
    std::string tally() const {
        return " (" + std::to_string(count) + (count == 1 ? " such value" : " such values") +
               " on this rank)";
    }
};

/// Returns true if a number is neither NaN nor infinite.
KOKKOS_INLINE_FUNCTION bool is_finite(double value) {
    return value >= -DBL_MAX && value <= DBL_MAX;
}

[[noreturn]] inline void reject_on_device(const std::string& what) {
    throw Error(ErrorCode::invalid_argument, what);
}

inline void check_coordinates(const Faults& faults) {
    if (faults.count > 0)
        reject_on_device("coordinate of point " + faults.place() + " on axis " + faults.axis() +
                         " is NaN or infinite" + faults.tally());
}

inline void check_weights(const Faults& faults) {
    if (faults.count > 0)
        reject_on_device("weight of point " + faults.place() + " is negative, NaN or infinite" +
                         faults.tally() + "; give 0 or more");
}

}  // namespace rrcb::detail
