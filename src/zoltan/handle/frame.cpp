#include "zoltan/handle/frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rrcb::zoltan {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Addend of a coordinate. An axis across `x` takes nothing of it, however large it is.
double share_of(const Frame& frame, std::size_t axis, std::size_t from, double x) {
    const double slope = frame.axes[axis][from];
    return slope == 0 ? 0 : slope * (x - frame.origin[from]);
}

/// Addends of both ends of a box, the lesser first.
std::array<double, 2> shares_of(const Frame& frame, std::size_t axis, std::size_t from,
                                const Box& box) {
    const double lower = share_of(frame, axis, from, box.lower[from]);
    const double upper = share_of(frame, axis, from, box.upper[from]);
    return {std::fmin(lower, upper), std::fmax(lower, upper)};
}

}  // namespace

double coordinate_along(const Frame& frame, int axis, const double* position) {
    const auto a = static_cast<std::size_t>(axis);
    if (frame.picked[a] >= 0) return position[frame.picked[a]];
    double sum = 0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(frame.dimension); ++j)
        sum += share_of(frame, a, j, position[j]);
    return sum;
}

Vector place(const Frame& frame, const double* position) {
    Vector placed{};
    for (int axis = 0; axis < frame.num_axes; ++axis)
        placed[static_cast<std::size_t>(axis)] = coordinate_along(frame, axis, position);
    return placed;
}

Box place(const Frame& frame, const Box& box) {
    Box placed;
    for (std::size_t a = 0; a < static_cast<std::size_t>(frame.num_axes); ++a) {
        if (frame.picked[a] >= 0) {
            const auto from = static_cast<std::size_t>(frame.picked[a]);
            placed.lower[a] = box.lower[from];
            placed.upper[a] = box.upper[from];
            continue;
        }
        // Added in the order of coordinate_along: every rounded addition is monotone, so the box
        // holds
        // the place of each position in it.
        double lower = 0;
        double upper = 0;
        for (std::size_t j = 0; j < static_cast<std::size_t>(frame.dimension); ++j) {
            const auto shares = shares_of(frame, a, j, box);
            lower += shares[0];
            upper += shares[1];
        }
        placed.lower[a] = std::isnan(lower) ? -infinity : lower;
        placed.upper[a] = std::isnan(upper) ? infinity : upper;
    }
    return placed;
}

Box unshifted(const Frame& frame, const Box& region) {
    Box shifted = region;
    for (std::size_t a = 0; a < static_cast<std::size_t>(frame.num_axes); ++a) {
        if (frame.picked[a] >= 0) continue;
        double shift = 0;
        for (std::size_t j = 0; j < static_cast<std::size_t>(frame.dimension); ++j)
            shift += frame.axes[a][j] * frame.origin[j];
        shifted.lower[a] += shift;
        shifted.upper[a] += shift;
    }
    return shifted;
}

Points place(const Frame& frame, const Points& points, Scratch<double>& scratch) {
    const auto num_axes = static_cast<std::size_t>(frame.num_axes);
    const std::size_t size = points.count * num_axes;
    double* coordinates = scratch.get(size);
    for (LocalIndex i = 0; i < points.count; ++i) {
        const Vector placed = place(frame, points.position(i).data());
        std::copy_n(placed.data(), num_axes, coordinates + i * num_axes);
    }
    return interleaved_points({coordinates, size}, frame.num_axes, points.weights);
}

bool is_sound(const Frame& frame) {
    if (!frame.turns()) return frame == Frame{};
    if (frame.dimension > max_dimension || frame.num_axes >= frame.dimension) return false;
    const auto finite = [](const Vector& vector) {
        return std::ranges::all_of(vector, [](double x) { return std::isfinite(x); });
    };
    const auto known = [&](std::int32_t axis) { return axis >= -1 && axis < frame.dimension; };
    return finite(frame.origin) && std::ranges::all_of(frame.axes, finite) &&
           std::ranges::all_of(frame.picked, known);
}

}  // namespace rrcb::zoltan
