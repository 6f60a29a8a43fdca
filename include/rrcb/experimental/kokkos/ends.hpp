#pragma once

#include <rrcb/experimental/kokkos/points.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace rrcb::detail {

/// Bounds of the coordinates and weights, and which points are at the bounds.
template <int Dimension>
struct Ends {
    static constexpr std::int64_t tied = -1;

    double bounds[2 * Dimension];  ///< least coordinate along each axis, then the greatest along
                                   ///< each
    std::int64_t points[2 * Dimension];  ///< point at each bound; `tied` if there are several
    double lightest;
    double heaviest;
    std::int64_t faults;
};

/// Finds the ends of all points. Reads weights if they count, and positions if asked to.
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

/// Finds, among all points at each bound, the first or the last in the order of the other axes.
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

/// Reduces all points by a functor to a value in the memory of the device.
template <class Device, class Functor>
void reduce(const Device& device, std::int64_t count, const Functor& functor,
            typename Functor::value_type* value) {
    const auto lock = lock_scratch<typename Device::Execution>();
    Kokkos::parallel_reduce(
        "rrcb::reduce", device.range(count), functor,
        Kokkos::View<typename Functor::value_type, typename Device::Memory>(value));
}

/// Bounds of coordinates and weights, positions at the bounds, and illegal coordinates.
template <int Dimension>
struct Found {
    Ends<Dimension> ends;
    Corners<Dimension> corners;
    Faults coordinates;
};

/// Finds illegal values.
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

/// Returns the coordinates that are not finite. Throws Error for an illegal weight. Ends with a
/// fence.
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

/// Returns the ends of the weights and, if `reads_positions`, of the positions. Throws Error for an
/// illegal weight. Ends with a fence; if several points share a bound, with two.
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

/// Adds up the weights of points.
template <class W>
struct AddWeights {
    static constexpr int fields = 1;
    static constexpr std::int64_t num_bins = 64;  // enough to keep threads from waiting for each
                                                  // other

    Weights<W> weights;

    KOKKOS_INLINE_FUNCTION Row<1> operator()(std::int64_t i) const {
        return {i / run_length % num_bins, {weights.units(i)}};
    }
};

/// Returns the sum of weights whose heaviest has been set. Throws Error if the sum overflows. Ends
/// with a fence.
template <class Device, class W>
double total_weight(Device& device, std::int64_t count, const Weights<W>& weights) {
    const std::vector<double> sums =
        sum_in_bins(device, count, AddWeights<W>::num_bins, std::vector{AddWeights<W>{weights}});
    const double total = weights.from_units(std::accumulate(sums.begin(), sums.end(), 0.0));
    require_on_device(std::isfinite(total), "the sum of the weights overflows; scale them down");
    return total;
}

}  // namespace rrcb::detail
