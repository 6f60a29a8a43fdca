#pragma once

#include <rrcb/experimental/kokkos/points.hpp>
#include <rrcb/experimental/kokkos/sums.hpp>

#include <cmath>
#include <cstdint>
#include <string>

namespace rrcb::detail {

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
        ends = {{}, {}, HUGE_VAL, 0, 0};
        for (int a = 0; a < dimension; ++a) {
            ends.bounds[a] = HUGE_VAL;
            ends.bounds[dimension + a] = -HUGE_VAL;
        }
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

/// Throws Error if a weight is illegal or, unless `are_weights`, if a coordinate is. Ends with a
/// fence.
template <class Device, class Positions, class W>
void check_values(const Device& device, const Positions& x, const Weights<W>& weights,
                  bool are_weights) {
    constexpr int dimension = Positions::static_dimension;
    std::int64_t number = 0;
    std::int64_t first = 0;
    const auto lock = lock_scratch<typename Device::Execution>();
    Kokkos::parallel_reduce(
        "rrcb::check_values", device.range(x.count * (are_weights ? 1 : dimension)),
        KOKKOS_LAMBDA(const std::int64_t k, std::int64_t& faults, std::int64_t& least) {
            const double value =
                are_weights ? weights(k) : x(k / dimension, static_cast<int>(k % dimension));
            if (is_finite(value) && (value >= 0 || !are_weights)) return;
            ++faults;
            if (k < least) least = k;
        },
        number, Kokkos::Min<std::int64_t>(first));
    const std::string tally = " (" + std::to_string(number) +
                              (number == 1 ? " such value" : " such values") + " on this rank)";
    require_on_device(number == 0 || !are_weights, "weight of point " + std::to_string(first) +
                                                       " is negative, NaN or infinite" + tally +
                                                       "; give 0 or more");
    require_on_device(number == 0, "coordinate of point " + std::to_string(first / dimension) +
                                       " on axis " + std::to_string(first % dimension) +
                                       " is NaN or infinite" + tally);
}

/// Returns the ends of the weights and, if `reads_positions`, of the positions. Ends with a fence.
template <bool Weighs, class Device, class Positions, class W>
Ends<Positions::static_dimension> find_ends(const Device& device, const Positions& x,
                                            const Weights<W>& weights, bool reads_positions) {
    Ends<Positions::static_dimension> ends;
    const auto lock = lock_scratch<typename Device::Execution>();
    Kokkos::parallel_reduce("rrcb::find_ends", device.range(x.count),
                            FindEnds<Positions, W, Weighs>{x, weights, reads_positions}, ends);
    return ends;
}

/// Returns the sum of weights whose heaviest has been set. Throws Error if the sum overflows. Ends
/// with a fence.
template <class Device, class W>
double total_weight(const Device& device, std::int64_t count, const Weights<W>& weights) {
    Word high = 0;
    Word low = 0;
    const auto lock = lock_scratch<typename Device::Execution>();
    Kokkos::parallel_reduce(
        "rrcb::total_weight", device.range(count),
        KOKKOS_LAMBDA(const std::int64_t i, Word& highs, Word& lows) {
            const auto units = static_cast<Word>(weights.units(i));
            highs += units >> low_bits;
            lows += units & low_mask;
        },
        high, low);
    const double total = weights.from_units(total_of(high, low));
    require_on_device(std::isfinite(total), "the sum of the weights overflows; scale them down");
    return total;
}

}  // namespace rrcb::detail
