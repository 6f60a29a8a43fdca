#include "parallel/ghost_nodes_mpi.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

namespace mpm::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Patches of four quadrants of a grid of 6 x 6 cells, cut inside a cell; more ranks hold nothing.
std::vector<NodeRange<2>> quadrant_patches(const GridShape& shape, int num_ranks) {
    const std::vector<Box> boxes{{{-infinity, -infinity}, {2.5, 2.5}},
                                 {{2.5, -infinity}, {infinity, 2.5}},
                                 {{-infinity, 2.5}, {2.5, infinity}},
                                 {{2.5, 2.5}, {infinity, infinity}}};
    std::vector<NodeRange<2>> patches(static_cast<std::size_t>(num_ranks));
    for (std::size_t rank = 0; rank < patches.size() && rank < boxes.size(); ++rank)
        patches[rank] = nodes_of<2>(shape, boxes[rank]);
    return patches;
}

GridPatch<2> patch_with(const GridShape& shape, const NodeRange<2>& nodes, double value) {
    GridPatch<2> patch;
    patch.shape = shape;
    resize<2>(patch, nodes);
    for (NodeSums<2>& node : patch.sums)
        node = {value, {2 * value, 3 * value}, {4 * value, 5 * value}};
    return patch;
}

const GridShape shape{.lower = {0, 0}, .spacing = 1, .num_cells = {6, 6}};

TEST(GhostNodes, adds_what_every_sharing_rank_has) {
    const int rank = rank_of(MPI_COMM_WORLD), num_ranks = size_of(MPI_COMM_WORLD);
    const auto patches = quadrant_patches(shape, num_ranks);
    const NodeRange<2>& mine = patches[static_cast<std::size_t>(rank)];
    GridPatch<2> patch = patch_with(shape, mine, std::pow(10, rank));
    GhostNodes<2> ghosts(patches, MPI_COMM_WORLD);
    ghosts.sum(patch);
    // The cell of the cuts has nodes 2 and 3 on each axis; the left patches end, the right begin.
    for (int j = mine.begin[1]; j < mine.begin[1] + mine.count[1]; ++j)
        for (int i = mine.begin[0]; i < mine.begin[0] + mine.count[0]; ++i) {
            double expected = 0;
            if (i <= 3 && j <= 3) expected += 1;
            if (i >= 2 && j <= 3 && num_ranks > 1) expected += 10;
            if (i <= 3 && j >= 2 && num_ranks > 2) expected += 100;
            if (i >= 2 && j >= 2 && num_ranks > 3) expected += 1000;
            const NodeSums<2>& node = patch.sums[patch.index({i, j})];
            EXPECT_EQ(node.mass, expected);
            EXPECT_EQ(node.momentum[0], 2 * expected);
            EXPECT_EQ(node.momentum[1], 3 * expected);
            EXPECT_EQ(node.force[0], 4 * expected);
            EXPECT_EQ(node.force[1], 5 * expected);
        }
}

TEST(GhostNodes, gives_all_ranks_the_same_bits) {
    const int rank = rank_of(MPI_COMM_WORLD);
    // 1 + 2^-53 + 2^-53 and so on: every order of summation rounds differently.
    const std::vector<double> values{1, 0x1p-53, 0x1p-53, -1};
    const std::vector<NodeRange<2>> patches(static_cast<std::size_t>(size_of(MPI_COMM_WORLD)),
                                            NodeRange<2>{{0, 0}, {2, 2}});
    GridPatch<2> patch = patch_with(shape, patches[0], values[static_cast<std::size_t>(rank % 4)]);
    GhostNodes<2> ghosts(patches, MPI_COMM_WORLD);
    ghosts.sum(patch);
    double least = patch.sums[0].mass, largest = least;
    MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_EQ(least, largest);
}

}  // namespace
}  // namespace mpm::test
