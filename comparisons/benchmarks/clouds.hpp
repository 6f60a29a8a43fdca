#pragma once

#include <cstddef>
#include <vector>

namespace rrcb::benchmarks {

/// How the points of a cloud follow one another in memory.
enum class Order { scattered, by_position };

/// Interleaved coordinates of points, uniform in the outline of a slope of 110 m x 35 m; the same
/// on every machine.
std::vector<double> slope_cloud(std::size_t count, Order order);

}  // namespace rrcb::benchmarks
