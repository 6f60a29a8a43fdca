#include "cells/vector_clones.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <algorithm>
#include <cstring>

namespace rrcb {

namespace {

/// Values in one register: the order of a minimum is free, but the compiler may not know it.
constexpr std::size_t width = 4;
typedef double Row __attribute__((vector_size(width * sizeof(double))));

// Independent of each other, and of values that are a multiple of every stride, so that each entry
// keeps to one axis.
constexpr std::size_t num_rows = 3;
constexpr std::size_t num_lanes = width * num_rows;

/// Range of some of the values, row by row.
struct Span {
    Row lower = Row{} + Box{}.lower[0];
    Row upper = Row{} + Box{}.upper[0];
    Row poison{};  ///< 0 * x is 0 just for finite x

    [[gnu::always_inline]] void widen(const double* values) {
        Row value;
        std::memcpy(&value, values, sizeof value);
        lower = lower < value ? lower : value;
        upper = upper > value ? upper : value;
        poison += 0 * value;
    }
};

/// Takes in whole multiples of num_lanes values; returns how many.
RRCB_VECTOR_CLONES
std::size_t widen(std::span<const double> values, std::array<Span, num_rows>& spans) {
    std::array<Span, num_rows> kept = spans;
    std::size_t k = 0;
    for (; k + num_lanes <= values.size(); k += num_lanes)
        for (std::size_t row = 0; row < num_rows; ++row) kept[row].widen(&values[k + width * row]);
    spans = kept;
    return k;
}

/// Smallest and largest of the values, entry k of axis k % stride; NaN in place of infinities.
Box box_of_values(std::span<const double> values, std::size_t stride) {
    std::array<Span, num_rows> spans;
    std::size_t k = widen(values, spans);
    // The last few, and others of their axes in place of those that are missing.
    if (k < values.size()) {
        std::array<double, num_lanes> rest;
        for (std::size_t lane = 0; lane < num_lanes; ++lane)
            rest[lane] = values[k + lane < values.size() ? k + lane : lane % stride];
        widen(rest, spans);
    }
    Box box;
    for (std::size_t lane = 0; lane < num_lanes; ++lane) {
        const Span& span = spans[lane / width];
        const std::size_t a = lane % stride;
        box.lower[a] = std::min(box.lower[a], span.lower[lane % width]);
        box.upper[a] = std::max(box.upper[a], span.upper[lane % width]);
    }
    for (std::size_t lane = 0; lane < num_lanes; ++lane) {
        box.lower[lane % stride] += spans[lane / width].poison[lane % width];
        box.upper[lane % stride] += spans[lane / width].poison[lane % width];
    }
    return box;
}

/// Smallest and largest of every stride-th value, on axis 0.
Box box_of_strided(const double* values, LocalIndex count, std::size_t stride) {
    Box box;
    double poison = 0;
    for (LocalIndex i = 0; i < count; ++i) {
        const double value = values[i * stride];
        box.lower[0] = std::min(box.lower[0], value);
        box.upper[0] = std::max(box.upper[0], value);
        poison += 0 * value;
    }
    box.lower[0] += poison;
    box.upper[0] += poison;
    return box;
}

/// Throws Error when points lie beyond their arrays.
void check_reach(const Points& points) {
    check_dimension(points.dimension, "points");
    require(points.stride >= 1, "the stride of the points must be at least 1");
    for (int a = 0; a < points.dimension; ++a) {
        const std::size_t size = points.axes[a].size();
        require(points.count == 0 || (size > 0 && (size - 1) / points.stride >= points.count - 1),
                "coordinate arrays must reach to the last point, (count - 1) * stride");
    }
}

}  // namespace

Points interleaved_points(std::span<const double> coordinates, int dimension,
                          std::span<const double> weights) {
    Points points;
    points.dimension = dimension;
    points.weights = weights;
    if (dimension < 1 || dimension > max_dimension) return points;
    points.stride = static_cast<std::size_t>(dimension);
    points.count = coordinates.size() / points.stride;
    for (std::size_t a = 0; a < points.stride && a <= coordinates.size(); ++a)
        points.axes[a] = coordinates.subspan(a);
    return points;
}

Points column_points(std::span<const std::span<const double>> columns,
                     std::span<const double> weights) {
    Points points;
    points.dimension = static_cast<int>(columns.size());
    points.weights = weights;
    if (columns.empty() || columns.size() > max_dimension) return points;
    points.count = columns[0].size();
    std::copy(columns.begin(), columns.end(), points.axes.begin());
    return points;
}

Box bounding_box(const Points& points) {
    check_reach(points);
    if (points.count == 0) return {};
    if (is_interleaved(points))
        return box_of_values(points.axes[0].first(points.count * points.stride), points.stride);
    Box box;
    for (int a = 0; a < points.dimension; ++a) {
        const Box axis = points.stride == 1
                             ? box_of_values(points.axes[a].first(points.count), 1)
                             : box_of_strided(points.axes[a].data(), points.count, points.stride);
        box.lower[a] = axis.lower[0];
        box.upper[a] = axis.upper[0];
    }
    return box;
}

}  // namespace rrcb
