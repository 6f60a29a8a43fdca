#pragma once

#include "arithmetic/vector_clones.hpp"
#include "cells/point_layout.hpp"

#include <rrcb/points.hpp>

#include <array>
#include <bit>
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

/// Copies a block of points; returns a number whose highest bit is 1 if a coordinate is not finite.
template <class Layout>
RRCB_VECTOR_CLONES std::uint64_t copy_block(const Layout& x, LocalIndex first, LocalIndex length,
                                            Columns& columns) {
    constexpr std::uint64_t magnitude = ~std::uint64_t{0} >> 1;
    constexpr std::uint64_t lowest_of_exponent = std::uint64_t{1} << 52;
    std::uint64_t carries = 0;
    for (LocalIndex i = 0; i < length; ++i) {
        for (int axis = 0; axis < Layout::dimension; ++axis) {
            const double value = x(first + i, axis);
            columns[axis][i] = value;
            // Only the largest exponent, that of infinities and NaN, carries into the sign.
            carries |= (std::bit_cast<std::uint64_t>(value) & magnitude) + lowest_of_exponent;
        }
    }
    return carries;
}

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
