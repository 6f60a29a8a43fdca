#pragma once

#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

namespace rrcb::test {

/// The same cloud for any number of ranks: every rank makes all of it and keeps each P-th point.
inline std::vector<double> share_of_cloud(
    std::size_t count, int dimension,
    const std::function<double(std::size_t i, int axis, double u)>& coordinate) {
    std::mt19937_64 engine(97);
    std::vector<double> mine;
    for (std::size_t i = 0; i < count; ++i) {
        for (int a = 0; a < dimension; ++a) {
            const double x = coordinate(i, a, uniform(engine));
            if (i % static_cast<std::size_t>(num_ranks()) == static_cast<std::size_t>(rank()))
                mine.push_back(x);
        }
    }
    return mine;
}

/// Columns of 100, 300 and 200 points: a plane can leave 100, 400 or 600 of them below, and only a
/// tilted cut halves them.
inline std::vector<double> three_columns() {
    std::vector<double> mine;
    for (int i = 0; i < 600; ++i) {
        if (i % num_ranks() != rank()) continue;
        mine.push_back(i < 100 ? 0 : i < 400 ? 1000 : 2000);
        mine.push_back(i);
    }
    return mine;
}

}  // namespace rrcb::test
