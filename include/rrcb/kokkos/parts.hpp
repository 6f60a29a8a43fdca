#pragma once

#include <rrcb/kokkos/points.hpp>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace rrcb::detail {

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

/// Returns the box of the points of each part. A fence.
template <class Memory, class Execution, class T>
std::vector<Box> boxes_of_parts(const Execution& exec, const Positions<T>& x, const Part* parts,
                                int num_parts) {
    const std::size_t size = 2 * max_dimension;
    std::vector<double> bounds(static_cast<std::size_t>(num_parts) * size, HUGE_VAL);
    const auto on_device = copy_in<Memory>(exec, std::span<const double>(bounds));
    Kokkos::parallel_for("rrcb::boxes", range(exec, x.count),
                         WidenBoxes<T>{x, parts, on_device.data()});
    copy_out(exec, on_device, std::span(bounds));
    exec.fence();
    std::vector<Box> boxes(static_cast<std::size_t>(num_parts));
    for (std::size_t p = 0; p < boxes.size(); ++p)
        for (std::size_t a = 0; a < max_dimension; ++a) {
            boxes[p].lower[a] = bounds[p * size + a];
            boxes[p].upper[a] = -bounds[p * size + max_dimension + a];
        }
    return boxes;
}

}  // namespace rrcb::detail
