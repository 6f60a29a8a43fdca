#pragma once

#include <rrcb/points.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace rrcb {

inline constexpr LocalIndex block_length = 512;

/// A plane with all points below it.
inline constexpr double nowhere = std::numeric_limits<double>::infinity();

/// The coordinates of the points of a block, one array per axis.
using Columns = std::array<std::array<double, block_length>, max_dimension>;

/// 1 for points of a block on a plane that breaks ties by position.
using TiedPoints = std::array<std::int32_t, block_length>;

/// Calls look_up(i, position) for the tied points of a block.
template <class LookUp>
void for_each_tied(const TiedPoints& tied, const Columns& columns, LocalIndex length, int dimension,
                   LookUp&& look_up) {
    std::array<LocalIndex, block_length> left;
    std::size_t num_left = 0;
    for (LocalIndex i = 0; i < length; ++i) {
        left[num_left] = i;
        num_left += static_cast<std::size_t>(tied[i]);
    }
    for (const LocalIndex i : std::span(left).first(num_left)) {
        Vector position{};
        for (int a = 0; a < dimension; ++a) position[a] = columns[a][i];
        look_up(i, position);
    }
}

}  // namespace rrcb
