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

/// A position in a kernel.
template <int Dimension>
struct Position {
    double x[Dimension];
};

/// Coordinates in the memory of a device, at any stride, or at 1. A dimension of 0 is known only in
/// a run, see with_dimension().
template <class T, int Dimension, bool IsUnit>
struct Positions {
    static constexpr int static_dimension = Dimension;

    const T* axes[max_dimension] = {};
    std::int64_t strides[max_dimension] = {};
    std::int64_t count = 0;
    int dimension = Dimension;
    bool are_even = true;  ///< all axes have `count` coordinates

    /// Returns a coordinate; -0 as 0, so that minima do not depend on an order.
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

/// Calls call(x) with positions whose dimension the compiler knows.
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

/// The views of positions: one of points by axes, or an array with one for each axis.
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

/// Bounds of the points and weights, and where they are.
template <int Dimension>
struct Ends {
    static constexpr std::int64_t tied = -1;

    double bounds[2 * Dimension];        ///< least along each axis, then greatest
    std::int64_t points[2 * Dimension];  ///< at each bound; `tied` if there are several
    double lightest;
    double heaviest;
    std::int64_t faults;
};

/// Finds the ends of all points; reads weights if they count, and positions if asked for.
template <class Positions, class W, bool Weighs>
struct FindEnds {
    static constexpr int dimension = Positions::static_dimension;
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
        for (int k = 0; k < 2 * dimension; ++k) {
            ends.bounds[k] = k < dimension ? HUGE_VAL : -HUGE_VAL;
            ends.points[k] = value_type::tied;
        }
        ends.lightest = Weighs ? HUGE_VAL : 1;
        ends.heaviest = Weighs ? 0 : 1;
        ends.faults = 0;
    }
    KOKKOS_INLINE_FUNCTION void join(value_type& ends, const value_type& others) const {
        widen(others.lightest, others.heaviest, ends);
        for (int k = 0; k < 2 * dimension; ++k) widen(k, others.bounds[k], others.points[k], ends);
        ends.faults += others.faults;
    }
    // For Kokkos before 3.7, which joins values in turns.
    KOKKOS_INLINE_FUNCTION void join(volatile value_type& ends,
                                     const volatile value_type& others) const {
        join(const_cast<value_type&>(ends), const_cast<const value_type&>(others));
    }

  private:
    KOKKOS_INLINE_FUNCTION static void widen(double lightest, double heaviest, value_type& ends) {
        if (lightest < ends.lightest) ends.lightest = lightest;
        if (heaviest > ends.heaviest) ends.heaviest = heaviest;
    }
    KOKKOS_INLINE_FUNCTION static void widen(int k, double value, std::int64_t i,
                                             value_type& ends) {
        const bool is_beyond = k < dimension ? value < ends.bounds[k] : value > ends.bounds[k];
        if (value == ends.bounds[k]) ends.points[k] = value_type::tied;
        if (is_beyond) ends.bounds[k] = value;
        if (is_beyond) ends.points[k] = i;
    }
};

/// Positions of the points at the bounds.
template <int Dimension>
struct Corners {
    Position<Dimension> positions[2 * Dimension];
};

/// Finds, of all points at each bound, the first by their axes in ascending order, or the last.
template <class Positions>
struct FindCorners {
    static constexpr int dimension = Positions::static_dimension;
    using value_type = Corners<dimension>;

    Positions x;
    Ends<dimension> ends;

    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, value_type& corners) const {
        const Position<dimension> p = x.position(i);
        for (int k = 0; k < 2 * dimension; ++k)
            if (p.x[k % dimension] == ends.bounds[k]) widen(k, p, corners);
    }
    KOKKOS_INLINE_FUNCTION void init(value_type& corners) const {
        for (int k = 0; k < 2 * dimension; ++k)
            for (double& bound : corners.positions[k].x)
                bound = k < dimension ? HUGE_VAL : -HUGE_VAL;
    }
    KOKKOS_INLINE_FUNCTION void join(value_type& corners, const value_type& others) const {
        for (int k = 0; k < 2 * dimension; ++k) widen(k, others.positions[k], corners);
    }
    KOKKOS_INLINE_FUNCTION void join(volatile value_type& corners,
                                     const volatile value_type& others) const {
        join(const_cast<value_type&>(corners), const_cast<const value_type&>(others));
    }

  private:
    KOKKOS_INLINE_FUNCTION static void widen(int k, const Position<dimension>& p,
                                             value_type& corners) {
        Position<dimension>& end = corners.positions[k];
        bool is_before = false;
        for (int a = dimension; a-- > 0;)
            if (p.x[a] != end.x[a]) is_before = p.x[a] < end.x[a];
        if (is_before == (k < dimension)) end = p;
    }
};

/// Reduces the points of a functor to a value in the memory of the device.
template <class Device, class Functor>
void reduce(const Device& device, std::int64_t count, const Functor& functor,
            typename Functor::value_type* value) {
    const auto lock = lock_scratch<typename Device::Execution>();
    Kokkos::parallel_reduce(
        "rrcb::reduce", device.range(count), functor,
        Kokkos::View<typename Functor::value_type, typename Device::Memory>(value));
}

/// Bounds of the points and weights, the positions at the bounds, and bad coordinates.
template <int Dimension>
struct Found {
    Ends<Dimension> ends;
    Corners<Dimension> corners;
    Faults coordinates;
};

/// Finds values that cannot be used.
template <class Positions, class W>
struct FindFaults {
    struct value_type {
        Faults coordinates;
        Faults weights;
    };
    Positions x;
    Weights<W> weights;

    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, value_type& faults) const {
        const double weight = weights(i);
        if (!(weight >= 0 && is_finite(weight))) faults.weights.add({1, 4 * i});
        for (int a = 0; a < Positions::static_dimension; ++a)
            if (!is_finite(x(i, a))) faults.coordinates.add({1, 4 * i + a});
    }
    KOKKOS_INLINE_FUNCTION void init(value_type& faults) const {
        faults.coordinates = faults.weights = {0, INT64_MAX};
    }
    KOKKOS_INLINE_FUNCTION void join(value_type& faults, const value_type& others) const {
        faults.coordinates.add(others.coordinates);
        faults.weights.add(others.weights);
    }
    KOKKOS_INLINE_FUNCTION void join(volatile value_type& faults,
                                     const volatile value_type& others) const {
        join(const_cast<value_type&>(faults), const_cast<const value_type&>(others));
    }
};

/// Returns the coordinates that are not finite; throws Error for a bad weight. A fence.
template <class Device, class Positions, class W>
Faults find_faults(Device& device, const Positions& x, const Weights<W>& weights) {
    using Functor = FindFaults<Positions, W>;
    const auto view = device.template lend<typename Functor::value_type>(1);
    reduce(device, x.count, Functor{x, weights}, view.data());
    const auto faults = device.copy_out(view)[0];
    require_on_device(faults.weights.count == 0, "weight of point " + faults.weights.point() +
                                                     " is negative, NaN or infinite" +
                                                     faults.weights.tally() + "; give 0 or more");
    return faults.coordinates;
}

/// Throws Error if a coordinate is not finite.
inline void check_coordinates(const Faults& faults) {
    require_on_device(faults.count == 0, "coordinate of point " + faults.point() + " on axis " +
                                             std::to_string(faults.first % 4) +
                                             " is NaN or infinite" + faults.tally());
}

/// Returns the ends of weights, and of positions if `reads_positions`. Throws Error for a bad
/// weight. A fence, with points that share a bound two.
template <bool Weighs, class Device, class Positions, class W>
Found<Positions::static_dimension> find_ends(Device& device, const Positions& x,
                                             const Weights<W>& weights, bool reads_positions) {
    constexpr int num_bounds = 2 * Positions::static_dimension;
    using Result = Found<Positions::static_dimension>;
    auto view = device.template lend<Result>(1);
    Result* const result = view.data();
    reduce(device, x.count, FindEnds<Positions, W, Weighs>{x, weights, reads_positions},
           &result->ends);
    if (reads_positions)
        Kokkos::parallel_for(
            "rrcb::corners", device.range(num_bounds), KOKKOS_LAMBDA(const std::int64_t k) {
                const std::int64_t i = result->ends.points[k];
                if (i >= 0) result->corners.positions[k] = x.position(i);
            });
    Result found = device.copy_out(view)[0];
    found.coordinates = {0, 0};
    if (found.ends.faults > 0)
        found.coordinates = find_faults(device, x, Weighs ? weights : Weights<W>{});
    const auto* const points = found.ends.points;
    if (!reads_positions || std::all_of(points, points + num_bounds, [](auto i) { return i >= 0; }))
        return found;
    view = device.template lend<Result>(1);
    reduce(device, x.count, FindCorners<Positions>{x, found.ends}, &view.data()->corners);
    found.corners = device.copy_out(view)[0].corners;
    return found;
}

/// Weights of points.
template <class W>
struct AddWeights {
    static constexpr int fields = 1;
    static constexpr std::int64_t num_bins = 64;  // as many as threads may meet

    Weights<W> weights;

    KOKKOS_INLINE_FUNCTION Row<1> operator()(std::int64_t i) const {
        return {i / run_length % num_bins, {weights.units(i)}};
    }
};

/// Returns the sum of weights whose heaviest is set; throws Error if it overflows. A fence.
template <class Device, class W>
double total_weight(Device& device, std::int64_t count, const Weights<W>& weights) {
    const std::vector<double> sums =
        sum_in_bins(device, count, AddWeights<W>::num_bins, std::vector{AddWeights<W>{weights}});
    const double total = weights.from_units(std::accumulate(sums.begin(), sums.end(), 0.0));
    require_on_device(std::isfinite(total), "the sum of the weights overflows; scale them down");
    return total;
}

}  // namespace rrcb::detail
