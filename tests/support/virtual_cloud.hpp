// Points of a great many virtual ranks.
#pragma once

#include "clouds.hpp"

#include <rrcb/points.hpp>

#include <cstddef>
#include <random>
#include <span>
#include <vector>

namespace rrcb::test {

/// Where the points of a rank lie.
enum class Layout {
    by_part,   ///< in the part that has its number, as where points hardly move
    by_row,    ///< in the square that has its number, row by row
    scattered  ///< anywhere
};

/// As many points on each of 4^k ranks, evenly in a square for each, or in all of them; squares are
/// a little longer than high, so that bisection cuts them along both axes in turn.
struct VirtualCloud {
    int side;  ///< squares along an axis, a power of two
    std::size_t points_per_rank;
    Layout layout;
    std::vector<double> coordinates;

    VirtualCloud(int num_squares_along, std::size_t points, Layout where)
        : side(num_squares_along), points_per_rank(points), layout(where) {
        const auto ranks = static_cast<std::size_t>(num_ranks());
        coordinates = uniform_cloud(points_per_rank * ranks, 2, 1);
        for (std::size_t i = 0; i < coordinates.size(); i += 2)
            move(std::span(coordinates).subspan(i, 2), static_cast<int>(i / (2 * points_per_rank)));
    }

    int num_ranks() const { return side * side; }

    Points points() const { return Points(coordinates, 2); }

    Points points_of(int rank) const {
        const std::size_t length = 2 * points_per_rank;
        return Points(
            std::span(coordinates).subspan(length * static_cast<std::size_t>(rank), length), 2);
    }

  private:
    /// Brings a point of the unit square to where those of a rank lie.
    void move(std::span<double> x, int rank) const {
        constexpr double stretch = 1.1;
        if (layout == Layout::scattered) {
            for (double& coordinate : x) coordinate *= side;
        } else {
            x[0] += layout == Layout::by_row ? rank % side : every_second_bit(rank >> 1);
            x[1] += layout == Layout::by_row ? rank / side : every_second_bit(rank);
        }
        x[0] *= stretch;
    }

    static int every_second_bit(int number) {
        int result = 0;
        for (int bit = 0; number >> (2 * bit) != 0; ++bit)
            result |= (number >> (2 * bit) & 1) << bit;
        return result;
    }
};

}  // namespace rrcb::test
