#pragma once

#include "held_points.hpp"

#include <rrcb/balance.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rrcb::test {

/// The same points on every rank: a lattice, on whose cuts many of them lie, or at random.
inline HeldPoints cloud(int dimension, std::size_t count, bool is_lattice) {
    HeldPoints all{dimension, uniform_cloud(count, dimension, 21)};
    if (is_lattice)
        for (double& x : all.coordinates) x = std::floor(12 * x);
    all.scatter();
    return all;
}

/// What each part weighs over all ranks, by looking up every point; by count without weight.
inline std::vector<double> weights_by_look_up(const HeldPoints& all, const Cuts& cuts) {
    const bool by_count = std::ranges::all_of(all.weights, [](double w) { return w == 0; });
    const Points points(all.coordinates, all.dimension);
    std::vector<double> weights(static_cast<std::size_t>(cuts.num_parts));
    for (std::size_t i = 0; i < points.count; ++i)
        weights[static_cast<std::size_t>(part_of(cuts, points.position(i)))] +=
            by_count ? 1 : all.weights[i];
    return weights;
}

inline bool same_cuts(const Cuts& a, const Cuts& b) {
    return std::ranges::equal(a.tree, b.tree, [](const Cut& one, const Cut& other) {
        return one.axis == other.axis && one.at == other.at;
    });
}

inline Options with_parts(int num_parts, double tolerance) {
    Options options;
    options.num_parts = num_parts;
    options.imbalance_tolerance = tolerance;
    return options;
}

}  // namespace rrcb::test
