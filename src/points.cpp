#include "point_layout.hpp"

#include <rrcb/points.hpp>

#include <algorithm>
#include <numeric>

namespace rrcb {

namespace {

// Independent lanes, as the order of a minimum is free and the compiler may not know it.
constexpr std::size_t num_lanes = 4;

template <class Layout>
Box box_of_layout(const Layout& x, LocalIndex count) {
    Box box;
    for (int axis = 0; axis < Layout::dimension; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        std::array<double, num_lanes> lower;
        std::array<double, num_lanes> upper;
        std::array<double, num_lanes> poison{};  // 0 * x is 0 just for finite x
        lower.fill(box.lower[a]);
        upper.fill(box.upper[a]);
        const auto widen = [&](LocalIndex i, std::size_t lane) {
            const double value = x(i, axis);
            lower[lane] = value < lower[lane] ? value : lower[lane];
            upper[lane] = value > upper[lane] ? value : upper[lane];
            poison[lane] += 0 * value;
        };
        LocalIndex i = 0;
        for (; i + num_lanes <= count; i += num_lanes)
            for (std::size_t lane = 0; lane < num_lanes; ++lane) widen(i + lane, lane);
        for (; i < count; ++i) widen(i, 0);
        const double finite = std::accumulate(poison.begin(), poison.end(), 0.0);
        box.lower[a] = *std::min_element(lower.begin(), lower.end()) + finite;
        box.upper[a] = *std::max_element(upper.begin(), upper.end()) + finite;
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
    return visit_layout(points, [&](const auto& x) { return box_of_layout(x, points.count); });
}

}  // namespace rrcb
