#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/detail/uninitialized.hpp>
#include <rrcb/kokkos/points.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace rrcb::detail {

/// Points of a part that are collected once more: lower <= x < upper.
struct WantedOfPart {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();
    std::int32_t axis = 0;
    std::int32_t wanted = 0;
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

/// Copies of points on the host.
struct Copies {
    Uninitialized<double> coordinates{};
    Uninitialized<double> weights{};
    std::vector<Part> taken{};
};

/// Copies points to the host; takes their parts if `parts` is not null. A fence.
template <class Memory, class Execution, class T, class W>
Copies copy_points(const Execution& exec, const Positions<T>& x, const Weights<W>& weights,
                   const LocalIndex* indices, LocalIndex number, Part* parts) {
    Copies copies;
    copies.coordinates.resize(number * static_cast<LocalIndex>(x.dimension));
    copies.weights.resize(weights.values != nullptr ? number : 0);
    copies.taken.resize(parts != nullptr ? number : 0);
    const auto coordinates = allocate<double, Memory>(exec, copies.coordinates.size());
    const auto copied_weights = allocate<double, Memory>(exec, copies.weights.size());
    const auto taken = allocate<Part, Memory>(exec, copies.taken.size());
    Kokkos::parallel_for("rrcb::copy", range(exec, static_cast<std::int64_t>(number)),
                         Copy<T, W>{x, weights, indices, coordinates.data(), copied_weights.data(),
                                    parts, taken.data()});
    copy_out(exec, coordinates, std::span(copies.coordinates));
    copy_out(exec, copied_weights, std::span(copies.weights));
    copy_out(exec, taken, std::span(copies.taken));
    exec.fence();
    return copies;
}

/// Returns the number of points that pass a test. A fence.
template <class Memory, class Execution, class Test>
LocalIndex count_points(const Execution& exec, std::int64_t count, const Test& test) {
    const auto number = allocate<std::int64_t, Memory>(exec, 1);
    Kokkos::parallel_reduce("rrcb::count", range(exec, count), Count<Test>{test},
                            Kokkos::View<std::int64_t, Memory>(number.data()));
    std::int64_t result = 0;
    copy_out(exec, number, std::span(&result, 1));
    exec.fence();
    return static_cast<LocalIndex>(result);
}

}  // namespace rrcb::detail
