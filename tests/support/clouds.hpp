#pragma once

#include <cstddef>
#include <random>
#include <vector>

namespace rrcb::test {

/// Uniform in [lower, upper), the same on every machine.
inline double uniform(std::mt19937_64& engine, double lower = 0, double upper = 1) {
    return lower + (upper - lower) * (static_cast<double>(engine() >> 11) * 0x1p-53);
}

/// Interleaved coordinates of `count` points, uniform in the unit cube.
inline std::vector<double> uniform_cloud(std::size_t count, int dimension, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::vector<double> coordinates(count * static_cast<std::size_t>(dimension));
    for (double& x : coordinates) x = uniform(engine);
    return coordinates;
}

}  // namespace rrcb::test
