// All points of a rank, as collected and as open ones.
#pragma once

#include "cuts/tree.hpp"
#include "passes/host_passes.hpp"
#include "passes/open_points.hpp"

#include <deque>
#include <limits>
#include <memory>
#include <vector>

namespace rrcb::test {

inline Collected all_collected(const Points& points) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Cuts cuts{.dimension = points.dimension, .num_parts = 2, .tree = {plane(0, 0)}};
    const Bracket anywhere{-infinity, infinity};
    Collected collected;
    HostPasses(points, std::vector<Part>(points.count))
        .collect(cuts, {&anywhere, 1}, false, collected);
    return collected;
}

/// Opens all points before any cut is known, as a spread search does.
inline std::unique_ptr<OpenPoints> all_open(PointPasses& points, int num_parts,
                                            const TreeShape& shape = {}) {
    static OpenMemory memory;       // which settle() uses once more
    static std::deque<Cuts> trees;  // which the open points borrow
    const Cuts& none = trees.emplace_back(
        Cuts{.dimension = points.dimension(), .num_parts = num_parts, .tree = {}, .shape = shape});
    return open_points(points, none, {}, false, memory);
}

}  // namespace rrcb::test
