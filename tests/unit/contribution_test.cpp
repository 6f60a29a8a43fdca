#include "contribution.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rrcb {
namespace {

TEST(AutomaticMesh, has_a_cell_for_every_sixteen_points_up_to_a_limit) {
    EXPECT_EQ(automatic_cells_per_axis(2, 0, 4), 1);
    EXPECT_EQ(automatic_cells_per_axis(2, 15, 4), 1);
    EXPECT_EQ(automatic_cells_per_axis(2, 16 * 49, 4), 7);
    EXPECT_EQ(automatic_cells_per_axis(2, 1000000, 4), 16);
    EXPECT_EQ(automatic_cells_per_axis(3, 16 * 27, 4), 3);
    EXPECT_EQ(automatic_cells_per_axis(3, 1000000, 4), 8);
    EXPECT_EQ(automatic_cells_per_axis(1, 1000000, 4), 64);
}

TEST(AutomaticMesh, never_sends_the_root_more_than_a_million_cells) {
    for (const int dimension : {1, 2, 3}) {
        for (int num_ranks = 1; num_ranks <= 1 << 20; num_ranks *= 2) {
            const int cells = automatic_cells_per_axis(dimension, 1u << 30, num_ranks);
            EXPECT_LE(std::pow(cells, dimension) * num_ranks, 1 << 20) << num_ranks;
        }
    }
}

}  // namespace
}  // namespace rrcb
