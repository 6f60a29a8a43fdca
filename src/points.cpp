#include <rrcb/points.hpp>

#include <algorithm>

namespace rrcb {

namespace {

// Independent lanes, as the order of a minimum is free and the compiler may not know it; a multiple
// of every stride, so that a lane keeps to one axis.
constexpr std::size_t num_lanes = 6;

/// Smallest and largest of the values, entry k of axis k % stride; NaN in place of infinities.
Box box_of_values(std::span<const double> values, std::size_t stride) {
    std::array<double, num_lanes> lower;
    std::array<double, num_lanes> upper;
    std::array<double, num_lanes> poison{};  // 0 * x is 0 just for finite x
    lower.fill(Box{}.lower[0]);
    upper.fill(Box{}.upper[0]);
    const auto widen = [&](double value, std::size_t lane) {
        lower[lane] = lower[lane] < value ? lower[lane] : value;
        upper[lane] = upper[lane] > value ? upper[lane] : value;
        poison[lane] += 0 * value;
    };
    const double* value = values.data();
    std::size_t k = 0;
    for (; k + num_lanes <= values.size(); k += num_lanes)
        for (std::size_t lane = 0; lane < num_lanes; ++lane) widen(value[k + lane], lane);
    for (std::size_t lane = 0; k < values.size(); ++k, ++lane) widen(value[k], lane);
    Box box;
    for (std::size_t lane = 0; lane < num_lanes; ++lane) {
        const std::size_t a = lane % stride;
        box.lower[a] = std::min(box.lower[a], lower[lane]);
        box.upper[a] = std::max(box.upper[a], upper[lane]);
    }
    for (std::size_t lane = 0; lane < num_lanes; ++lane) {
        box.lower[lane % stride] += poison[lane];
        box.upper[lane % stride] += poison[lane];
    }
    return box;
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
    if (points.stride > 1)
        return box_of_values(points.axes[0].first(points.count * points.stride), points.stride);
    Box box;
    for (std::size_t a = 0; a < static_cast<std::size_t>(points.dimension); ++a) {
        const Box axis = box_of_values(points.axes[a].first(points.count), 1);
        box.lower[a] = axis.lower[0];
        box.upper[a] = axis.upper[0];
    }
    return box;
}

}  // namespace rrcb
