#pragma once

#include <rrcb/kokkos/points.hpp>
#include <rrcb/kokkos/sums.hpp>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace rrcb::detail {

/// Values that cannot be used.
struct Faults {
    std::int64_t count;
    std::int64_t first;  ///< least of 4 i + axis

    KOKKOS_INLINE_FUNCTION void add(const Faults& others) {
        count += others.count;
        if (others.first < first) first = others.first;
    }
    /// Returns words for an error.
    std::string tally() const {
        return std::to_string(count) + (count == 1 ? " such value" : " such values") +
               " on this rank";
    }
};

/// Ends of the points in the order across each axis, and of the weights.
struct Ends {
    Position first[max_dimension];
    Position last[max_dimension];
    double lightest;
    double heaviest;
    Faults coordinates;
    Faults weights;
};

/// Finds the ends of all points; reads positions, weights or both.
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
        for (int a = 0; a < max_dimension; ++a) {
            if (!is_finite(p.x[a])) ends.coordinates.add({1, 4 * i + a});
            if (a < x.dimension) widen(a, p, p, ends);
        }
    }
    KOKKOS_INLINE_FUNCTION void init(Ends& ends) const {
        for (int a = 0; a < max_dimension; ++a)
            for (int b = 0; b < max_dimension; ++b) {
                ends.first[a].x[b] = HUGE_VAL;
                ends.last[a].x[b] = -HUGE_VAL;
            }
        ends.lightest = HUGE_VAL;
        ends.heaviest = 0;
        ends.coordinates = ends.weights = {0, INT64_MAX};
    }
    KOKKOS_INLINE_FUNCTION void join(Ends& ends, const Ends& others) const {
        widen(others.lightest, others.heaviest, ends);
        for (int a = 0; a < max_dimension; ++a) widen(a, others.first[a], others.last[a], ends);
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
    KOKKOS_INLINE_FUNCTION static void widen(int axis, const Position& first, const Position& last,
                                             Ends& ends) {
        if (is_before(axis, first, ends.first[axis])) ends.first[axis] = first;
        if (is_before(axis, ends.last[axis], last)) ends.last[axis] = last;
    }
    KOKKOS_INLINE_FUNCTION static bool is_before(int axis, const Position& p, const Position& q) {
        if (p.x[axis] != q.x[axis]) return p.x[axis] < q.x[axis];
        for (int a = 0; a < max_dimension; ++a)
            if (p.x[a] != q.x[a]) return p.x[a] < q.x[a];
        return false;
    }
};

/// Returns the ends of weights, and of positions if `reads_positions`. Throws Error for weights
/// that cannot be used. A fence.
template <class Device, class T, class W>
Ends find_ends(Device& device, const Positions<T>& x, const Weights<W>& weights,
               bool reads_positions) {
    const auto view = device.template lend<Ends>(1);
    Kokkos::parallel_reduce("rrcb::summary", device.range(x.count),
                            FindEnds<T, W>{x, weights, reads_positions},
                            Kokkos::View<Ends, typename Device::Memory>(view.data()));
    Ends ends;
    device.copy_out(view, std::span<Ends>(&ends, 1));
    device.fence();
    if (ends.weights.count > 0)
        reject_on_device("weight of point " + std::to_string(ends.weights.first / 4) +
                         " is negative, NaN or infinite (" + ends.weights.tally() +
                         "); give 0 or more");
    return ends;
}

/// Throws Error if a coordinate is not finite.
inline void check_coordinates(const Ends& ends) {
    if (ends.coordinates.count > 0)
        reject_on_device("coordinate of point " + std::to_string(ends.coordinates.first / 4) +
                         " on axis " + std::to_string(ends.coordinates.first % 4) +
                         " is NaN or infinite (" + ends.coordinates.tally() + ")");
}

/// Returns the sum of weights whose heaviest is set; throws Error if it overflows. A fence.
template <class Device, class W>
double total_weight(Device& device, std::int64_t count, const Weights<W>& weights) {
    // As many bins as threads may meet.
    constexpr int num_bins = 64;
    const std::vector<double> sums = sum_in_bins(
        device, count, num_bins,
        KOKKOS_LAMBDA(const std::int64_t i, const Bins<typename Device::Execution>& bins) {
            bins.add(i % num_bins, weights.units(i));
        });
    const double total = weights.from_units(std::accumulate(sums.begin(), sums.end(), 0.0));
    if (!std::isfinite(total))
        reject_on_device("the sum of the weights overflows; scale them down");
    return total;
}

}  // namespace rrcb::detail
