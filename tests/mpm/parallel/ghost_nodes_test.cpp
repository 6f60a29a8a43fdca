#include "balancers_mpi.hpp"
#include "parallel/ghost_nodes_mpi.hpp"
#include "transfer/shape_functions.hpp"
#include "variations.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <set>

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

/// Sums the nodes of a patch over all ranks. Returns how many this rank shares and reaches.
std::size_t sum(const std::vector<NodeRange<2>>& ranges, GridPatch<2>& patch) {
    const rrcb::Box all{{0, 0, 0}, {1, 1, 0}};
    rrcb::Neighbours neighbours(std::vector<rrcb::Box>(ranges.size(), all), 2, MPI_COMM_WORLD, {});
    GhostNodes<2> ghosts(ranges, rank_of(MPI_COMM_WORLD));
    ghosts.number(patch);
    std::span<double> sums = ghosts.sums_of(patch);
    neighbours.sum(ghosts.shared(), rrcb::column(sums, 5), patch.fields);
    return ghosts.num_shared();
}

const GridShape shape{.lower = {0, 0}, .spacing = 1, .num_cells = {6, 6}};

TEST(GhostNodes, gives_all_ranks_the_same_bits) {
    const int rank = rank_of(MPI_COMM_WORLD);
    // 1 + 2^-53 + 2^-53 and so on: every order of summation rounds differently.
    const std::vector<double> values{1, 0x1p-53, 0x1p-53, 0.25};
    const std::vector<NodeRange<2>> patches(static_cast<std::size_t>(size_of(MPI_COMM_WORLD)),
                                            NodeRange<2>{{0, 0}, {2, 2}});
    GridPatch<2> patch = patch_with(shape, patches[0], values[static_cast<std::size_t>(rank % 4)]);
    sum(patches, patch);
    double least = patch.sums[0].mass, largest = least;
    MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_EQ(least, largest);
}

// Rank r reaches columns r and r + 1 of nodes 0 to 3 along y, but not the node (r, 1).
TEST(GhostNodes, sends_the_nodes_that_points_reach) {
    const int rank = rank_of(MPI_COMM_WORLD), num_ranks = size_of(MPI_COMM_WORLD);
    std::vector<NodeRange<2>> ranges;
    for (int r = 0; r < num_ranks; ++r) ranges.push_back({{r - 1, 0}, {4, 4}});
    GridPatch<2> patch = patch_with(shape, {{rank, 0}, {2, 4}}, 1);
    patch.sums[patch.index({rank, 1})] = {};
    const std::size_t num_shared = sum(ranges, patch);
    const bool has_left = rank > 0, has_right = rank + 1 < num_ranks;
    EXPECT_EQ(patch.sums[patch.index({rank, 0})].mass, has_left ? 2 : 1);
    EXPECT_EQ(patch.sums[patch.index({rank, 1})].mass, has_left ? 1 : 0);
    EXPECT_EQ(patch.sums[patch.index({rank + 1, 1})].mass, 1);
    EXPECT_EQ(patch.sums[patch.index({rank + 1, 2})].force[1], has_right ? 10 : 5);
    EXPECT_EQ(num_shared, num_ranks > 1 ? 7U : 0U);
}

/// Nodes that the points of each rank reach and those of others, too, summed over the ranks.
double reached_by_two(const Simulation& simulation, const Scene& scene) {
    std::set<std::array<int, 2>> reached;
    const Positions at = simulation.positions();
    const bool is_linear = scene.shape_function == ShapeFunction::linear;
    const auto first = [&](double x, std::size_t axis) {
        return is_linear ? LinearShape().first_node(scene.grid, x, axis)
                         : QuadraticShape().first_node(scene.grid, x, axis);
    };
    for (std::size_t p = 0; p < at.size(); ++p)
        for (int i = 0; i < (is_linear ? 2 : 3); ++i)
            for (int j = 0; j < (is_linear ? 2 : 3); ++j)
                reached.insert({first(at.x[p], 0) + i, first(at.y[p], 1) + j});
    std::vector<double> codes;
    for (const auto& [i, j] : reached)
        if (i >= 0 && j >= 0) codes.push_back(i + 1e6 * j);
    std::map<double, int> num_ranks;
    for (const double code : sorted_over_ranks(codes, MPI_COMM_WORLD)) ++num_ranks[code];
    double shared = 0;
    for (const auto& [code, count] : num_ranks) shared += count > 1 ? count : 0;
    return shared;
}

struct Case {
    const char* scene;
    double cell_size, end_time;
};

/// Largest number of nodes that ranks send, by those that two reach, over some steps.
double most_sent(const Case& example) {
    const Scene scene = shipped(example.scene, example.cell_size);
    Simulation simulation(scene, MPI_COMM_WORLD);
    const Balancer balancer = rrcb_balancer({}, {}, true);
    double most = 0, sent = 0, shared = 0;
    while (simulation.time() < example.end_time) {
        const std::int64_t step = simulation.step_count();
        if (step % 50 == 0) simulation.rebalance(balancer);
        const double reached = step % 25 == 0 ? reached_by_two(simulation, scene) : 0;
        simulation.step();
        if (step % 25 != 0 || reached == 0) continue;
        sent = static_cast<double>(simulation.totals().num_ghost_nodes);
        shared = reached;
        most = std::max(most, sent / reached);
    }
    if (rank_of(MPI_COMM_WORLD) == 0)
        std::printf("%s, %d ranks: at %.2f s %.0f nodes sent, %.0f reached by two; most %.2f\n",
                    example.scene, size_of(MPI_COMM_WORLD), simulation.time(), sent, shared, most);
    return most;
}

// If a cut is next to a face of cells, one of its ranks sends a row of nodes that the other does
// not reach: a single cut may send up to 1.7 times the nodes. MPM_FULL_SIZE=1 for the shipped
// cells. Between boxes that touch the same cells ranks once sent all nodes, up to 13 times as many
// in the dam break.
TEST(GhostNodes, sends_few_more_than_two_ranks_reach) {
    if (size_of(MPI_COMM_WORLD) < 3) GTEST_SKIP() << "a single cut may be next to faces of cells";
    const bool is_full = std::getenv("MPM_FULL_SIZE") != nullptr;
    for (const Case& example :
         is_full ? std::vector<Case>{{"dam_break", 0.05, 1.2},
                                     {"granular_column", 0.1, 1},
                                     {"slope", 1, 2}}
                 : std::vector<Case>{
                       {"dam_break", 0.2, 1.2}, {"granular_column", 0.2, 1}, {"slope", 4, 2}})
        EXPECT_LT(most_sent(example), 1.5) << example.scene;
}

}  // namespace
}  // namespace mpm::test
