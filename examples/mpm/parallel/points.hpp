#pragma once

#include <rrcb/points.hpp>

#include <mpm/decomposition.hpp>

#include <array>
#include <span>
#include <vector>

namespace mpm {

/// Returns a view of positions for RRCB.
inline rrcb::Points points_of(Positions at) {
    const std::array columns{at.x, at.y, at.z};
    return rrcb::Points(std::span(columns).first(static_cast<std::size_t>(at.dimension)));
}

/// Returns the boxes of all ranks for RRCB.
inline std::vector<rrcb::Box> boxes_of(const Decomposition& decomposition) {
    std::vector<rrcb::Box> boxes;
    for (const Box& box : decomposition.boxes) boxes.push_back({box.lower, box.upper});
    return boxes;
}

}  // namespace mpm
