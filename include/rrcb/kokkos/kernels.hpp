#pragma once

#include <rrcb/kokkos/sums.hpp>
#include <rrcb/kokkos/tree.hpp>
#include <rrcb/method/support_mesh.hpp>

#include <cfloat>
#include <cmath>
#include <cstdint>

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

/// Layers of a mesh along an axis, in scaled lengths.
struct Layers {
    double scale;
    double lower;  ///< of the frame
    double per_length;
    double below_number;  ///< greatest double below the number of layers
    std::int32_t number;
    const double* middles;   ///< of each layer
    const double* per_side;  ///< reciprocal of its thickness
};

/// Adds up the moments of points about the middle of their cell, in units of its sides.
template <class T, class W>
struct MomentsBody {
    Positions<T> x;
    Weights<W> weights;
    Layers layers[max_dimension];
    std::int64_t num_cells;
    int first_axis;  ///< of the axes to sum; with axis 0 come counts, and weights if there are any
    int num_axes;

    template <class Bins>
    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, const Bins& bins) const {
        double offset[max_dimension];
        std::int64_t bin = 0;
        for (int a = max_dimension; a-- > 0;)
            if (a < x.dimension) bin = bin * layers[a].number + find_layer(i, a, offset[a]);
        const double weight = weights.values == nullptr ? 1 : weights.relative(i);
        if (first_axis == 0) {
            bins.add(bin, 1);
            bin += num_cells;
            if (weights.values != nullptr) {
                bins.add(bin, to_units(weight, weight_bits));
                bin += num_cells;
            }
        }
        for (int a = 0; a < max_dimension; ++a) {
            if (a < first_axis || a >= first_axis + num_axes) continue;
            const double first = weight * offset[a];
            bins.add(bin, to_units(first, weight_bits));
            bins.add(bin + num_cells, to_units(first * offset[a], square_bits));
            bin += 2 * num_cells;
        }
    }

  private:
    /// Returns the layer of a point, and its offset from the middle.
    KOKKOS_INLINE_FUNCTION std::int32_t find_layer(std::int64_t i, int axis, double& offset) const {
        const Layers& of = layers[axis];
        const double value = x(i, axis) * of.scale;
        double place = (value - of.lower) * of.per_length;
        place = place < of.below_number ? place : of.below_number;
        const auto layer = static_cast<std::int32_t>(place > 0 ? place : 0);
        offset = (value - of.middles[layer]) * of.per_side[layer];
        offset = offset > -0.5 ? offset : -0.5;
        offset = offset < 0.5 ? offset : 0.5;
        return layer;
    }
};

/// True for points without a part.
struct IsOpen {
    const Part* parts;
    KOKKOS_INLINE_FUNCTION bool operator()(std::int64_t i) const { return parts[i] < 0; }
};

/// True for points that are collected once more.
template <class T>
struct IsWanted {
    Positions<T> x;
    const Part* parts;
    const WantedOfPart* of_parts;

    KOKKOS_INLINE_FUNCTION bool operator()(std::int64_t i) const {
        if (parts[i] < 0) return false;
        const WantedOfPart& of = of_parts[parts[i]];
        const double value = x(i, of.axis);
        return value >= of.lower && value < of.upper;
    }
};

/// Counts points.
template <class Test>
struct Count {
    Test test;

    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, std::int64_t& number) const {
        if (test(i)) ++number;
    }
};

/// Lists points in ascending order of their indices.
template <class Test>
struct List {
    using value_type = std::int64_t;

    Test test;
    LocalIndex* found;

    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, std::int64_t& number,
                                           bool is_final) const {
        if (!test(i)) return;
        if (is_final) found[number] = static_cast<LocalIndex>(i);
        ++number;
    }
};

/// Copies some points; takes their parts if `parts` is not null.
template <class T, class W>
struct Copy {
    Positions<T> x;
    Weights<W> weights;
    const LocalIndex* indices;
    double* coordinates;
    double* copied_weights;
    Part* parts;
    Part* taken;

    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t k) const {
        const auto i = static_cast<std::int64_t>(indices[k]);
        for (int a = 0; a < x.dimension; ++a) coordinates[k * x.dimension + a] = x(i, a);
        if (weights.values != nullptr) copied_weights[k] = weights(i);
        if (parts == nullptr) return;
        taken[k] = parts[i];
        parts[i] = no_part;
    }
};

/// Widens the boxes of parts: minima along each axis, then minus the maxima.
template <class T>
struct WidenBoxes {
    Positions<T> x;
    const Part* parts;
    double* bounds;

    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i) const {
        if (parts[i] < 0) return;
        double* const box = bounds + static_cast<std::int64_t>(parts[i]) * 2 * max_dimension;
        for (int a = 0; a < x.dimension; ++a) {
            lower(&box[a], x(i, a));
            lower(&box[max_dimension + a], -x(i, a));
        }
    }
    KOKKOS_INLINE_FUNCTION static void lower(double* bound, double value) {
        // Most points need no atomic operation; an old bound costs one.
        if (value < *static_cast<volatile double*>(bound)) Kokkos::atomic_fetch_min(bound, value);
    }
};

/// Gives some points their parts.
struct SetParts {
    const LocalIndex* indices;
    const Part* from;
    Part* parts;
    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t k) const { parts[indices[k]] = from[k]; }
};

/// Replaces parts by other numbers.
struct Renumber {
    const Part* numbers;
    Part* parts;
    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i) const { parts[i] = numbers[parts[i]]; }
};

}  // namespace rrcb::detail
