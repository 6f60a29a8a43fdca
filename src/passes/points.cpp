#include "arithmetic/non_stop.hpp"
#include "arithmetic/vector_clones.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"
#include "passes/summary.hpp"

#include <algorithm>
#include <cstring>

namespace rrcb {

namespace {

/// Values of one vector register. Without them the compiler may not reorder the minimum of doubles.
constexpr std::size_t row_width = 4;
typedef double Row __attribute__((vector_size(row_width * sizeof(double))));
typedef float FloatRow __attribute__((vector_size(row_width * sizeof(float))));

[[gnu::always_inline]] inline void load(const double* values, Row& row) {
    std::memcpy(&row, values, sizeof row);
}

[[gnu::always_inline]] inline void load(const float* values, Row& row) {
    FloatRow floats;
    std::memcpy(&floats, values, sizeof floats);
    row = __builtin_convertvector(floats, Row);
}

// Number of independent rows. The number of their values is a multiple of every stride (1, 2, 3),
// so that each lane belongs to one axis.
constexpr std::size_t num_rows = 3;
constexpr std::size_t num_lanes = row_width * num_rows;

/// Range of the values in each lane of a row.
struct Span {
    Row lower = Row{} + Box{}.lower[0];
    Row upper = Row{} + Box{}.upper[0];
    Row poison{};  ///< sum of 0 * x, which is 0 only if all x are finite

    template <class Scalar>
    [[gnu::always_inline]] void widen(const Scalar* values) {
        Row value;
        load(values, value);
        lower = lower < value ? lower : value;
        upper = upper > value ? upper : value;
        poison += 0 * value;
    }
};

/// Widens the spans by a multiple of num_lanes values. Returns the number of values read.
template <class Scalar>
RRCB_VECTOR_CLONES std::size_t widen(std::span<const Scalar> values,
                                     std::array<Span, num_rows>& spans) {
    std::array<Span, num_rows> kept = spans;
    std::size_t k = 0;
    for (; k + num_lanes <= values.size(); k += num_lanes)
        for (std::size_t row = 0; row < num_rows; ++row)
            kept[row].widen(&values[k + row_width * row]);
    spans = kept;
    return k;
}

/// Returns the box of values of which number k is on axis k % stride. Returns NaN if a value is not
/// finite.
template <class Scalar>
Box box_of_values(std::span<const Scalar> values, std::size_t stride) {
    std::array<Span, num_rows> spans;
    std::size_t k = widen(values, spans);
    // Pads the last few values with others of the same axes.
    if (k < values.size()) {
        std::array<Scalar, num_lanes> rest;
        for (std::size_t lane = 0; lane < num_lanes; ++lane)
            rest[lane] = values[k + lane < values.size() ? k + lane : lane % stride];
        widen(std::span<const Scalar>(rest), spans);
    }
    Box box;
    for (std::size_t lane = 0; lane < num_lanes; ++lane) {
        const Span& span = spans[lane / row_width];
        const std::size_t a = lane % stride;
        box.lower[a] = std::min(box.lower[a], span.lower[lane % row_width]);
        box.upper[a] = std::max(box.upper[a], span.upper[lane % row_width]);
    }
    for (std::size_t lane = 0; lane < num_lanes; ++lane) {
        box.lower[lane % stride] += spans[lane / row_width].poison[lane % row_width];
        box.upper[lane % stride] += spans[lane / row_width].poison[lane % row_width];
    }
    return box;
}

/// Returns the range of every stride-th value, as that of axis 0.
template <class Scalar>
Box box_of_strided(const Scalar* values, LocalIndex count, std::size_t stride) {
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

template <class Scalar>
Box box_of_axes(const Points& points) {
    const std::size_t stride = points.stride / sizeof(Scalar);
    const auto axis_of = [&](std::size_t axis) {
        return static_cast<const Scalar*>(points.axes[axis]);
    };
    if (is_interleaved(points))
        return box_of_values(std::span(axis_of(0), points.count * stride), stride);
    Box box;
    for (std::size_t a = 0; a < static_cast<std::size_t>(points.dimension); ++a) {
        const Box axis = stride == 1 ? box_of_values(std::span(axis_of(a), points.count), 1)
                                     : box_of_strided(axis_of(a), points.count, stride);
        box.lower[a] = axis.lower[0];
        box.upper[a] = axis.upper[0];
    }
    return box;
}

}  // namespace

Box bounding_box(const Points& points) {
    const NonStop arithmetic;
    check_layout(points);
    return box_of(points);
}

Box box_of(const Points& points) {
    if (points.count == 0) return {};
    return points.type == ScalarType::float32 ? box_of_axes<float>(points)
                                              : box_of_axes<double>(points);
}

}  // namespace rrcb
