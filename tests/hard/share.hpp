#pragma once

#include "cloud.hpp"

#include <span>
#include <vector>

namespace rrcb::hard_test {

/// One rank's points of a cloud.
struct Share {
    int dimension = 0;
    std::vector<int> numbers;  ///< of the points in the cloud, ascending
    std::vector<double> coordinates;
    std::vector<double> weights;  ///< empty when every point weighs 1

    Points points() const { return Points(coordinates, dimension, weights); }
};

enum class Layout {
    scattered,  ///< each point on the next rank
    sorted      ///< neighbours on the same rank, by the first axis
};

/// Number of the rank that holds each of `count` points.
std::vector<int> owners_of(const Cloud& cloud, int count, Layout layout, int num_ranks);

/// What a rank holds when `owners` hold the points of the cloud.
Share share_of(const Cloud& cloud, std::span<const int> owners, int rank);

}  // namespace rrcb::hard_test
