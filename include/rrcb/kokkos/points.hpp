#pragma once

#include <rrcb/kokkos/device.hpp>

#include <array>
#include <cfloat>
#include <cmath>
#include <numeric>

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
};

/// The type of a view in positions: of points by axes, or one of an array for each axis.
template <class Views>
struct ViewOf {
    using Type = Views;
};
template <class Axis, std::size_t N>
struct ViewOf<std::array<Axis, N>> {
    static_assert(N >= 1 && N <= max_dimension, "give a view for each of 1 to 3 axes");
    using Type = Axis;
};
template <class Views>
using MemoryOf = typename ViewOf<Views>::Type::memory_space;
template <class Views>
using ScalarOf = typename ViewOf<Views>::Type::non_const_value_type;

template <class Views>
Positions<ScalarOf<Views>> positions_of(const Views& views) {
    Positions<ScalarOf<Views>> x;
    const auto add = [&x](int a, const auto& axis) {
        const auto length = static_cast<std::int64_t>(axis.extent(0));
        if (a == 0) x.count = length;
        x.are_even = x.are_even && length == x.count;
        x.axes[a] = axis.data();
        x.strides[a] = static_cast<std::int64_t>(axis.stride(0));
    };
    if constexpr (Kokkos::is_view<Views>::value)
        x.dimension = static_cast<int>(views.extent(1));
    else
        x.dimension = static_cast<int>(views.size());
    for (int a = 0; a < std::min(x.dimension, max_dimension); ++a)
        if constexpr (Kokkos::is_view<Views>::value)
            add(a, Kokkos::subview(views, Kokkos::ALL, a));
        else
            add(a, views[static_cast<std::size_t>(a)]);
    return x;
}

/// Bits behind the point of sums of weights and first moments, and of second moments.
inline constexpr int weight_bits = 46;
inline constexpr int square_bits = 48;

/// Returns a number below 2^51 in units of 2^-bits.
KOKKOS_INLINE_FUNCTION std::int64_t to_units(double value, int bits) {
    // A sum with 1.5 * 2^52 is rounded to an integer.
    constexpr double shift = 0x1.8p52;
    const double units = value * static_cast<double>(std::int64_t{1} << bits);
    return static_cast<std::int64_t>(units + shift - shift);
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

/// Values that cannot be used.
struct Faults {
    std::int64_t count;
    std::int64_t first;  ///< least of 4 i + axis

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

/// Ends of the points in the order across each axis, and of the weights.
struct Ends {
    Position positions[2 * max_dimension];  ///< first across each axis, then last
    double lightest;
    double heaviest;
    Faults coordinates;
    Faults weights;
};

/// Finds the ends of all points; reads weights, and positions if asked for.
template <class T, class W>
struct FindEnds {
    using value_type = Ends;

    Positions<T> x;
    Weights<W> weights;
    bool reads_positions;

    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, Ends& ends) const {
        const double weight = weights(i);
        if (!(weight >= 0 && is_finite(weight))) ends.weights.add({1, 4 * i});
        widen(weight, weight, ends);
        if (!reads_positions) return;
        const Position p = x.position(i);
        for (int a = 0; a < max_dimension; ++a)
            if (!is_finite(p.x[a])) ends.coordinates.add({1, 4 * i + a});
        for (int k = 0; k < 2 * max_dimension; ++k) widen(k, p, ends);
    }
    KOKKOS_INLINE_FUNCTION void init(Ends& ends) const {
        for (int k = 0; k < 2 * max_dimension; ++k)
            for (double& bound : ends.positions[k].x)
                bound = k < max_dimension ? HUGE_VAL : -HUGE_VAL;
        ends.lightest = HUGE_VAL;
        ends.heaviest = 0;
        ends.coordinates = ends.weights = {0, INT64_MAX};
    }
    KOKKOS_INLINE_FUNCTION void join(Ends& ends, const Ends& others) const {
        widen(others.lightest, others.heaviest, ends);
        for (int k = 0; k < 2 * max_dimension; ++k) widen(k, others.positions[k], ends);
        ends.coordinates.add(others.coordinates);
        ends.weights.add(others.weights);
    }
    // For Kokkos before 3.7, which joins values in turns.
    KOKKOS_INLINE_FUNCTION void join(volatile Ends& ends, const volatile Ends& others) const {
        join(const_cast<Ends&>(ends), const_cast<const Ends&>(others));
    }

  private:
    KOKKOS_INLINE_FUNCTION static void widen(double lightest, double heaviest, Ends& ends) {
        if (lightest < ends.lightest) ends.lightest = lightest;
        if (heaviest > ends.heaviest) ends.heaviest = heaviest;
    }
    KOKKOS_INLINE_FUNCTION static void widen(int k, const Position& p, Ends& ends) {
        Position& end = ends.positions[k];
        const bool is_first = k < max_dimension;
        int axis = is_first ? k : k - max_dimension;
        // Equal ones are compared along the axes in ascending order.
        for (int a = 0; p.x[axis] == end.x[axis] && a < max_dimension; ++a) axis = a;
        if (is_first ? p.x[axis] < end.x[axis] : p.x[axis] > end.x[axis]) end = p;
    }
};

/// Returns the ends of weights, and of positions if `reads_positions`. Throws Error for values that
/// cannot be used. A fence.
template <class Device, class T, class W>
Ends find_ends(Device& device, const Positions<T>& x, const Weights<W>& weights,
               bool reads_positions) {
    const auto view = device.template lend<Ends>(1);
    Kokkos::parallel_reduce("rrcb::summary", device.range(x.count),
                            FindEnds<T, W>{x, weights, reads_positions},
                            Kokkos::View<Ends, typename Device::Memory>(view.data()));
    const Ends ends = device.copy_out(view)[0];
    require_on_device(ends.weights.count == 0, "weight of point " + ends.weights.point() +
                                                   " is negative, NaN or infinite" +
                                                   ends.weights.tally() + "; give 0 or more");
    return ends;
}

/// Throws Error if a coordinate is not finite.
inline void check_coordinates(const Faults& faults) {
    require_on_device(faults.count == 0, "coordinate of point " + faults.point() + " on axis " +
                                             std::to_string(faults.first % 4) +
                                             " is NaN or infinite" + faults.tally());
}

/// Returns the sum of weights whose heaviest is set; throws Error if it overflows. A fence.
template <class Device, class W>
double total_weight(Device& device, std::int64_t count, const Weights<W>& weights) {
    // As many bins as threads may meet.
    constexpr int num_bins = 64;
    const auto add =
        KOKKOS_LAMBDA(const std::int64_t i, const Bins<typename Device::Execution>& bins) {
        bins.add(i % num_bins, weights.units(i));
    };
    const std::vector<double> sums = sum_in_bins(device, count, num_bins, std::vector{add});
    const double total = weights.from_units(std::accumulate(sums.begin(), sums.end(), 0.0));
    require_on_device(std::isfinite(total), "the sum of the weights overflows; scale them down");
    return total;
}

}  // namespace rrcb::detail
