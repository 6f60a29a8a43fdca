#pragma once

#include "../support/ranks.hpp"

#include <rrcb/cuts.hpp>

#include <functional>
#include <limits>

namespace rrcb::test {

/// A row of unit squares, one for each rank, and the cuts between them.
inline Cuts slabs() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Cuts cuts{2, num_ranks(), {}};
    const std::function<void(int, int)> cut = [&](int first, int count) {
        if (count == 1) return;
        const int below = cuts.shape.lower_parts(count);
        cuts.tree.push_back({0, 0, {static_cast<double>(first + below), -infinity, -infinity}});
        cut(first, below);
        cut(first + below, count - below);
    };
    cut(0, num_ranks());
    return cuts;
}

}  // namespace rrcb::test
