// Cuts by groups of parts, such as those of one machine.
#include "../support/distance.hpp"
#include "clouds_of_all_ranks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/ghosts.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/quality.hpp>

namespace rrcb {
namespace {

using test::share_of_cloud;

struct Machines {
    int count;
    int parts_each;
    int round_robin_block = 0;
};

constexpr Machines machines[] = {{3, 4},    {5, 3},    {6, 2},    {3, 28},
                                 {3, 4, 1}, {5, 4, 2}, {6, 2, 1}, {4, 9, 3}};

Options options_for(const Machines& all, bool larger_below) {
    Options options{.num_parts = all.count * all.parts_each,
                    .expert = {.tree = {all.parts_each, larger_below, all.round_robin_block}}};
    return options;
}

std::vector<double> cloud_here(int dimension) {
    return share_of_cloud(6000, dimension,
                          [](std::size_t, int axis, double u) { return std::pow(u, 1 + axis); });
}

/// The parts in the order of the ends of the tree, as
/// the documentation of TreeShape describes it.
std::vector<Part> parts_of_ends(const Machines& all) {
    std::vector<std::vector<Part>> groups(static_cast<std::size_t>(all.count));
    const int at_once = all.round_robin_block == 0 ? all.parts_each : all.round_robin_block;
    for (Part part = 0; part < all.count * all.parts_each; ++part)
        groups[static_cast<std::size_t>(part / at_once % all.count)].push_back(part);
    std::vector<Part> parts;
    for (const std::vector<Part>& group : groups)
        parts.insert(parts.end(), group.begin(), group.end());
    return parts;
}

/// The ends of the tree below each node in preorder, as the documentation of TreeShape describes
/// it.
struct Node {
    Part first;
    int num_below;
    int num_parts;
};

void append_nodes(Part first, int num_parts, const Machines& all, bool larger_below,
                  std::vector<Node>& nodes) {
    if (num_parts == 1) return;
    const bool has_groups = num_parts > all.parts_each;
    const int halved = has_groups ? num_parts / all.parts_each : num_parts;
    const int half = larger_below ? (halved + 1) / 2 : halved / 2;
    const int below = has_groups ? half * all.parts_each : half;
    nodes.push_back({first, below, num_parts});
    append_nodes(first, below, all, larger_below, nodes);
    append_nodes(first + below, num_parts - below, all, larger_below, nodes);
}

std::vector<Node> nodes_of(const Machines& all, bool larger_below) {
    std::vector<Node> nodes;
    append_nodes(0, all.count * all.parts_each, all, larger_below, nodes);
    return nodes;
}

/// Whether all cuts have the position on the side of an end of the tree.
bool leave_to(Part end, const Cuts& cuts, const std::vector<Node>& nodes, const Vector& x) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const Node& node = nodes[k];
        if (end < node.first || end >= node.first + node.num_parts) continue;
        const bool is_end_above = end >= node.first + node.num_below;
        if (is_above(cuts.tree[k], x, cuts.dimension) != is_end_above) return false;
    }
    return true;
}

/// Calls check(machines, larger_below) for each shape of tree.
template <class Check>
void for_each_shape(Check&& check) {
    for (const Machines& all : machines) {
        for (const bool larger_below : {false, true}) {
            SCOPED_TRACE(std::to_string(all.count) + " x " + std::to_string(all.parts_each) +
                         (all.round_robin_block > 0 ? " dealt" : "") +
                         (larger_below ? ", larger below" : ""));
            check(all, larger_below);
        }
    }
}

TEST(TreeShape, halves_parts_by_default) {
    for (int num_parts = 2; num_parts < 100; ++num_parts)
        EXPECT_EQ(TreeShape{}.lower_parts(num_parts), num_parts / 2);
}

TEST(TreeShape, leaves_the_last_group_as_many_parts_as_there_are) {
    const TreeShape by_four{4};
    EXPECT_EQ(by_four.lower_parts(5), 4);
    EXPECT_EQ(by_four.lower_parts(11), 4);
    EXPECT_EQ(by_four.lower_parts(13), 8);
    EXPECT_EQ((TreeShape{4, true}.lower_parts(11)), 8);
    EXPECT_EQ((TreeShape{4, true}.lower_parts(3)), 2);
}

TEST(TreeShape, each_point_is_where_the_cuts_of_whole_groups_put_it) {
    for_each_shape([](const Machines& all, bool larger_below) {
        for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
            Options options = options_for(all, larger_below);
            options.refine = refine;
            const std::vector<double> coordinates = cloud_here(2);
            const Points points(coordinates, 2);
            const Balance result = balance(points, MPI_COMM_WORLD, options);
            EXPECT_EQ(result.cuts.shape, options.expert.tree);
            const std::vector<Node> nodes = nodes_of(all, larger_below);
            ASSERT_EQ(result.cuts.tree.size(), nodes.size());
            const std::vector<Part> numbers = parts_of_ends(all);
            for (LocalIndex i = 0; i < points.count; ++i) {
                const Vector x = points.position(i);
                const auto end = std::ranges::find(numbers, result.parts[i]) - numbers.begin();
                ASSERT_TRUE(leave_to(static_cast<Part>(end), result.cuts, nodes, x));
                ASSERT_EQ(part_of(result.cuts, x), result.parts[i]);
                ASSERT_EQ(parts_touching(result.cuts, {x, x}), std::vector{result.parts[i]});
            }
            if (refine == Refine::none) continue;
            EXPECT_TRUE(result.report.within_tolerance) << result.report.imbalance;
        }
    });
}

TEST(TreeShape, is_that_of_cuts_by_many_ranks) {
    if (num_ranks() < 3) GTEST_SKIP() << "rank 0 makes two parts and more alone";
    for_each_shape([](const Machines& all, bool larger_below) {
        Options options = options_for(all, larger_below);
        options.expert.max_root_parts = 2;
        if (all.round_robin_block > 0) {
            EXPECT_THROW(balance(Points({}, 3), MPI_COMM_WORLD, options), Error);
            return;
        }
        const std::vector<double> coordinates = cloud_here(3);
        const Points points(coordinates, 3);
        const Balance spread = balance(points, MPI_COMM_WORLD, options);
        EXPECT_TRUE(spread.report.within_tolerance) << spread.report.imbalance;
        const std::vector<Node> nodes = nodes_of(all, larger_below);
        for (LocalIndex i = 0; i < points.count; ++i)
            ASSERT_TRUE(leave_to(spread.parts[i], spread.cuts, nodes, points.position(i)));
        EXPECT_EQ(assign(spread.cuts, points, MPI_COMM_WORLD), spread.parts);
        const Balance again = balance(points, MPI_COMM_WORLD, options, spread.cuts);
        EXPECT_EQ(again.parts, spread.parts);
    });
}

TEST(TreeShape, is_that_of_earlier_cuts) {
    Options options{.expert = {.tree = {2, true}}};
    const std::vector<double> coordinates = cloud_here(2);
    const Points points(coordinates, 2);
    const Balance first = balance(points, MPI_COMM_WORLD, options);
    const Balance again = balance(points, MPI_COMM_WORLD, options, first.cuts);
    EXPECT_EQ(again.parts, first.parts);
    EXPECT_EQ(again.cuts.shape, options.expert.tree);
    Options other = options;
    other.expert.tree = {};
    if (num_ranks() == 1) return;
    EXPECT_THROW(balance(points, MPI_COMM_WORLD, other, first.cuts), Error);
}

TEST(TreeShape, of_no_parts_in_a_group_is_refused) {
    Options options{.expert = {.tree = {.group_size = -1}}};
    EXPECT_THROW(balance(Points({}, 2), MPI_COMM_WORLD, options), Error);
    options.num_parts = 10;
    for (const TreeShape& shape :
         {TreeShape{4, false, 1}, {5, false, 2}, {3, false, -1}, {0, false, 2}}) {
        options.expert.tree = shape;
        EXPECT_THROW(balance(Points({}, 2), MPI_COMM_WORLD, options), Error);
    }
}

TEST(TreeShape, ghosts_are_the_points_near_the_boxes_of_other_ranks) {
    constexpr double radius = 0.05;
    for_each_shape([](const Machines& all, bool larger_below) {
        const Options options = options_for(all, larger_below);
        const std::vector<double> coordinates = cloud_here(2);
        const Points points(coordinates, 2);
        Cuts cuts = balance(points, MPI_COMM_WORLD, options).cuts;
        cuts = unstamped(cuts);  // the points stay where they are
        const GhostPlan found = ghost_plan(cuts, points, MPI_COMM_WORLD, {.cutoff = radius});
        std::vector<std::size_t> expected;
        for (int to = 0; to < num_ranks(); ++to) {
            for (LocalIndex i = 0; i < points.count && to != rank(); ++i) {
                bool is_near = false;
                for (Part part = 0; part < options.num_parts && !is_near; ++part) {
                    const RankRange ranks = ranks_of_part(part, options.num_parts, num_ranks());
                    if (to < ranks.first_rank || to >= ranks.first_rank + ranks.count) continue;
                    is_near = test::distance(points.position(i), box_of(cuts, part), 2) <= radius;
                }
                if (is_near) expected.push_back(i);
            }
        }
        EXPECT_EQ(found.send_indices, expected);
    });
}

}  // namespace
}  // namespace rrcb
