#include "clouds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace rrcb::benchmarks {

namespace {

using Point = std::array<double, 2>;

Point slope_point(std::mt19937_64& engine) {
    const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
    while (true) {
        const Point point{110 * uniform(), 35 * uniform() - 15};
        const double surface = std::clamp(50 - point[0], 0.0, 20.0);
        if (point[1] <= surface) return point;
    }
}

/// Columns of a metre, each from the bottom to the top: neighbours in memory are near in space.
bool is_before(const Point& a, const Point& b) {
    const double column_a = std::floor(a[0]);
    const double column_b = std::floor(b[0]);
    return column_a < column_b || (column_a == column_b && a[1] < b[1]);
}

}  // namespace

std::vector<double> slope_cloud(std::size_t count, Order order) {
    std::mt19937_64 engine(7);
    std::vector<Point> points(count);
    std::ranges::generate(points, [&] { return slope_point(engine); });
    if (order == Order::by_position) std::ranges::sort(points, is_before);
    std::vector<double> coordinates;
    for (const Point& point : points)
        coordinates.insert(coordinates.end(), point.begin(), point.end());
    return coordinates;
}

}  // namespace rrcb::benchmarks
