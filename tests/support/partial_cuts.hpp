#pragma once

#include <rrcb/cuts.hpp>

#include <algorithm>
#include <set>
#include <span>
#include <vector>

namespace rrcb::test {

/// Numbers in preorder of the cuts above a part, the first one first.
inline std::vector<std::int32_t> path_to(Part part, int num_parts, const TreeShape& shape) {
    std::vector<std::int32_t> path;
    std::int32_t node = 0;
    while (num_parts > 1) {
        path.push_back(node);
        const int below = shape.lower_parts(num_parts);
        if (part < below) {
            node += 1;
            num_parts = below;
        } else {
            node += below;
            part -= below;
            num_parts -= below;
        }
    }
    return path;
}

/// Those of a whole tree above some parts.
inline Cuts cut_down(const Cuts& whole, std::span<const Part> parts) {
    std::set<std::int32_t> nodes;
    for (const Part part : parts)
        for (const std::int32_t node : path_to(part, whole.num_parts, whole.shape))
            nodes.insert(node);
    Cuts cuts{whole.dimension, whole.num_parts, {}, {nodes.begin(), nodes.end()}, whole.shape};
    for (const std::int32_t node : cuts.nodes)
        cuts.tree.push_back(whole.tree[static_cast<std::size_t>(node)]);
    return cuts;
}

inline bool knows(const Cuts& cuts, Part part) {
    return std::ranges::includes(cuts.nodes, path_to(part, cuts.num_parts, cuts.shape));
}

}  // namespace rrcb::test
