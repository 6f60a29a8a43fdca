#include "parallel/carried_motion_mpi.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

namespace mpm::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const GridShape shape{.lower = {0, 0, 0}, .spacing = 1, .num_cells = {7, 6, 5}};

/// Slabs across an axis, in the order of the ranks or against it; ranks beyond `most` have none.
std::vector<NodeRange<3>> slab_patches(std::size_t axis, bool backwards, int most) {
    const int num_ranks = size_of(MPI_COMM_WORLD), num_slabs = std::min(num_ranks, most);
    std::vector<NodeRange<3>> patches(static_cast<std::size_t>(num_ranks));
    for (int k = 0; k < num_slabs; ++k) {
        Box box{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
        const double width = static_cast<double>(shape.num_cells[axis]) / num_slabs;
        if (k > 0) box.lower[axis] = k * width;
        if (k + 1 < num_slabs) box.upper[axis] = (k + 1) * width;
        const int rank = backwards ? num_ranks - 1 - k : k;
        patches[static_cast<std::size_t>(rank)] = nodes_of<3>(shape, box, 1);
    }
    return patches;
}

NodeMotion<3> motion_of(const std::array<int, 3>& node) {
    const double number = node[0] + 10 * node[1] + 100 * node[2];
    return {{number, 0.5, -number}, {2 * number, 1, 3}, {number + 0.25, number, 7}};
}

GridPatch<3> patch_of(const std::vector<NodeRange<3>>& patches) {
    GridPatch<3> patch;
    patch.shape = shape;
    resize<3>(patch, patches[static_cast<std::size_t>(rank_of(MPI_COMM_WORLD))]);
    return patch;
}

void expect_carried(const std::vector<NodeRange<3>>& before,
                    const std::vector<NodeRange<3>>& after) {
    GridPatch<3> from = patch_of(before), to = patch_of(after);
    visit_nodes<3>(from.nodes,
                   [&](const auto& node) { from.motion[from.index(node)] = motion_of(node); });
    for (NodeMotion<3>& motion : to.motion) motion.velocity[0] = -1;
    carry_motion<3>(before, after, from.motion, to, MPI_COMM_WORLD);
    visit_nodes<3>(to.nodes, [&](const std::array<int, 3>& node) {
        const NodeMotion<3>&found = to.motion[to.index(node)], expected = motion_of(node);
        EXPECT_EQ(found.velocity, expected.velocity);
        EXPECT_EQ(found.velocity_change, expected.velocity_change);
        EXPECT_EQ(found.strain_velocity, expected.strain_velocity);
    });
}

TEST(CarriedMotion, comes_to_whoever_has_the_node_next) {
    constexpr int all = 100;
    expect_carried(slab_patches(0, false, all), slab_patches(1, true, all));
    expect_carried(slab_patches(2, false, all), slab_patches(2, true, all));
    expect_carried(slab_patches(2, false, all), slab_patches(2, false, all));
}

TEST(CarriedMotion, comes_from_and_to_ranks_without_nodes) {
    expect_carried(slab_patches(0, false, 2), slab_patches(1, true, 3));
    expect_carried(slab_patches(1, true, 1), slab_patches(0, false, 1));
}

TEST(CarriedMotion, is_rest_where_no_rank_had_the_node) {
    const std::vector<NodeRange<3>> nowhere(static_cast<std::size_t>(size_of(MPI_COMM_WORLD)));
    const std::vector<NodeRange<3>> after = slab_patches(0, false, 2);
    GridPatch<3> from = patch_of(nowhere), to = patch_of(after);
    for (NodeMotion<3>& motion : to.motion) motion = motion_of({1, 2, 3});
    carry_motion<3>(nowhere, after, from.motion, to, MPI_COMM_WORLD);
    for (const NodeMotion<3>& motion : to.motion) {
        EXPECT_EQ(motion.velocity, Components<3>{});
        EXPECT_EQ(motion.strain_velocity, Components<3>{});
    }
}

}  // namespace
}  // namespace mpm::test
