#pragma once

#include <rrcb/kokkos/sums.hpp>

#include <array>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <span>

namespace rrcb::detail {

/// Ends of the points in the order across each axis, and of the weights.
struct Ends {
    Position first[max_dimension];
    Position last[max_dimension];
    double lightest;
    double heaviest;
};

/// Finds the ends of all points; reads positions, weights or both.
template <class T, class W>
struct FindEnds {
    using value_type = Ends;

    Positions<T> x;
    Weights<W> weights;
    bool reads_positions;
    Faults* of_coordinates;
    Faults* of_weights;

    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, Ends& ends) const {
        const double weight = weights(i);
        if (!(weight >= 0 && weight <= DBL_MAX)) of_weights->add(i, 0);
        if (weight < ends.lightest) ends.lightest = weight;
        if (weight > ends.heaviest) ends.heaviest = weight;
        if (!reads_positions) return;
        const Position p = x.position(i);
        for (int a = 0; a < max_dimension; ++a)
            if (!is_finite(p.x[a])) of_coordinates->add(i, a);
        widen(p, p, ends);
    }
    KOKKOS_INLINE_FUNCTION void init(Ends& ends) const {
        for (int a = 0; a < max_dimension; ++a)
            for (int b = 0; b < max_dimension; ++b) {
                ends.first[a].x[b] = HUGE_VAL;
                ends.last[a].x[b] = -HUGE_VAL;
            }
        ends.lightest = HUGE_VAL;
        ends.heaviest = 0;
    }
    KOKKOS_INLINE_FUNCTION void join(Ends& ends, const Ends& others) const {
        if (others.lightest < ends.lightest) ends.lightest = others.lightest;
        if (others.heaviest > ends.heaviest) ends.heaviest = others.heaviest;
        for (int a = 0; a < max_dimension; ++a) {
            widen_axis(a, others.first[a], others.last[a], ends);
        }
    }
    // For Kokkos before 3.7, which joins values in turns.
    KOKKOS_INLINE_FUNCTION void join(volatile Ends& ends, const volatile Ends& others) const {
        join(const_cast<Ends&>(ends), const_cast<const Ends&>(others));
    }

  private:
    KOKKOS_INLINE_FUNCTION void widen(const Position& first, const Position& last,
                                      Ends& ends) const {
        for (int a = 0; a < max_dimension; ++a)
            if (a < x.dimension) widen_axis(a, first, last, ends);
    }
    KOKKOS_INLINE_FUNCTION void widen_axis(int axis, const Position& first, const Position& last,
                                           Ends& ends) const {
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

/// Adds up weights in as many bins as threads may meet.
template <class W>
struct WeighBody {
    static constexpr int num_bins = 64;
    Weights<W> weights;

    template <class Bins>
    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, const Bins& bins) const {
        bins.add(i % num_bins, weights.units(i));
    }
};

/// Ends of all points, and the coordinates that cannot be used.
struct FoundEnds {
    Ends ends;
    Faults of_coordinates;
};

/// Finds the ends of weights, and of positions if `reads_positions`. Throws Error for unusable
/// weights. A fence.
template <class Memory, class Execution, class T, class W>
FoundEnds find_ends(const Execution& exec, const Positions<T>& x, const Weights<W>& weights,
                    bool reads_positions) {
    const auto faults = allocate<Faults, Memory>(exec, 2, true);
    const auto ends = allocate<Ends, Memory>(exec, 1);
    const FindEnds<T, W> find{x, weights, reads_positions, faults.data(), faults.data() + 1};
    Kokkos::parallel_reduce("rrcb::summary", range(exec, x.count), find,
                            Kokkos::View<Ends, Memory>(ends.data()));
    FoundEnds found;
    std::array<Faults, 2> bad;
    copy_out(exec, ends, std::span<Ends>(&found.ends, 1));
    copy_out(exec, faults, std::span<Faults>(bad));
    exec.fence();
    found.of_coordinates = bad[0];
    check_weights(bad[1]);
    return found;
}

/// Returns the sum of weights whose heaviest is set; throws Error if it overflows. A fence.
template <class Memory, class Execution, class W>
double total_weight(const Execution& exec, std::int64_t count, const Weights<W>& weights) {
    const WeighBody<W> body{weights};
    double units = 0;
    for (const double sum :
         sum_in_bins<Memory>(exec, count, body.num_bins, {}, [&](Word*) { return body; }))
        units += sum;
    const double total = weights.from_units(units);
    if (!std::isfinite(total))
        reject_on_device("the sum of the weights overflows; scale them down");
    return total;
}

}  // namespace rrcb::detail
