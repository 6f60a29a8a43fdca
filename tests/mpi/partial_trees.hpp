#pragma once

#include "../support/partial_cuts.hpp"
#include "../support/ranks.hpp"

#include <rrcb/plan.hpp>

#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace rrcb::test {

/// The same tree on every rank, with zeros, infinities and both signs, in groups of 1 to 3 parts.
inline Cuts random_cuts(int dimension, int num_parts) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::mt19937_64 engine(static_cast<unsigned>(num_parts));
    Cuts cuts{dimension, num_parts, {}, {}, {1 + num_parts % 3, num_parts % 2 == 0}};
    for (int k = 1; k < num_parts; ++k) {
        Cut cut;
        cut.axis = static_cast<std::int32_t>(engine() % static_cast<unsigned>(dimension));
        cut.divides = static_cast<std::int32_t>(engine() % 2);
        for (double& x : cut.at)
            x = engine() % 4 == 0 ? -infinity : static_cast<double>(engine() % 9) - 4;
        cuts.tree.push_back(cut);
    }
    return cuts;
}

/// Planes at 1, 2, ... in one dimension: the part of a position is what is before its point.
inline Cuts planes(int num_parts) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Cuts cuts{1, num_parts, {}};
    const std::function<void(Part, int)> divide = [&](Part first, int count) {
        if (count == 1) return;
        const int below = cuts.shape.lower_parts(count);
        cuts.tree.push_back({0, 0, {static_cast<double>(first + below), -infinity, -infinity}});
        divide(first, below);
        divide(first + below, count - below);
    };
    divide(0, num_parts);
    return cuts;
}

/// What a rank knows of a tree: the paths to its own parts, and to some others.
inline Cuts known_here(const Cuts& whole, std::vector<Part> also = {}) {
    for (Part part = 0; part < whole.num_parts; ++part) {
        const RankRange ranks = ranks_of_part(part, whole.num_parts, num_ranks());
        if (rank() >= ranks.first_rank && rank() < ranks.first_rank + ranks.count)
            also.push_back(part);
    }
    return cut_down(whole, also);
}

}  // namespace rrcb::test
