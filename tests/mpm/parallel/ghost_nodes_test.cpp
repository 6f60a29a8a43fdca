#include "parallel/ghost_nodes_mpi.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

namespace mpm::test {
namespace {

GridPatch<2> patch_with(const GridShape& shape, const NodeRange<2>& nodes, double value) {
    GridPatch<2> patch;
    patch.shape = shape;
    resize<2>(patch, nodes);
    for (NodeSums<2>& node : patch.sums)
        node = {value, {2 * value, 3 * value}, {4 * value, 5 * value}};
    return patch;
}

const GridShape shape{.lower = {0, 0}, .spacing = 1, .num_cells = {6, 6}};

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
