#pragma once

#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/points.hpp>

namespace rrcb::test {

/// Points of one rank, which every rank can make.
struct Share {
    int dimension = 2;
    std::vector<double> coordinates;
    std::vector<double> weights;  ///< empty: every point weighs 1

    Points points() const { return Points(coordinates, dimension, weights); }
};

using MakeShare = std::function<Share(int rank)>;

/// The same number of points on every rank, crowded near the origin.
inline Share crowded_share(int of_rank) {
    Share share{2, test::uniform_cloud(300, 2, static_cast<unsigned>(of_rank + 1)), {}};
    for (double& x : share.coordinates) x *= x;
    return share;
}

/// No points on odd ranks; whole weights, some of them 0.
inline Share weighted_share(int of_rank) {
    const std::size_t count = of_rank % 2 == 1 ? 0 : 200 + 10 * static_cast<std::size_t>(of_rank);
    Share share{3, test::uniform_cloud(count, 3, static_cast<unsigned>(of_rank + 7)), {}};
    for (std::size_t i = 0; i < count; ++i) share.weights.push_back(static_cast<double>(i % 5));
    return share;
}

/// Different places of a lattice, of which many share each coordinate.
inline Share lattice_share(int of_rank) {
    Share share{2, {}, {}};
    for (int k = of_rank; k < 20 * 24; k += num_ranks())
        share.coordinates.insert(share.coordinates.end(), {double(k % 20), double(k / 20)});
    return share;
}

}  // namespace rrcb::test
