// Collected points on their way down a tree, against looking at every point.
#include "../support/all_collected.hpp"
#include "../support/clouds.hpp"
#include "passes/host_passes.hpp"
#include "search/collected_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Cut plane_at(int axis, double value) {
    Cut cut;
    cut.axis = axis;
    cut.at.fill(-infinity);
    cut.at[static_cast<std::size_t>(axis)] = value;
    return cut;
}

/// Four parts of the unit square: cut at 1/2 across x, then across y.
struct Square {
    std::vector<double> coordinates = test::uniform_cloud(2000, 2, 7);
    std::vector<double> weights{};
    Cuts cuts{2, 4, {plane_at(0, 0.5), plane_at(1, 0.5), plane_at(1, 0.5)}, {}, {}};
    std::optional<HostPasses> passes{};

    Points points() const { return interleaved_points(coordinates, 2, weights); }
    CollectedTree tree(double width) {
        const std::vector<Bracket> intervals(3, {0.5 - width, 0.5 + width});
        passes.emplace(points());
        passes->summary(true);
        return {*passes, cuts, intervals, false, {}};
    }
    double weight_in(double x0, double x1, double y0, double y1) const {
        double weight = 0;
        for (LocalIndex i = 0; i < points().count; ++i) {
            const Vector x = points().position(i);
            if (x[0] >= x0 && x[0] < x1 && x[1] >= y0 && x[1] < y1) weight += points().weight(i);
        }
        return weight;
    }
};

Square weighted_square() {
    Square made;
    for (std::size_t i = 0; i < 2000; ++i) made.weights.push_back(0.5 + static_cast<double>(i % 5));
    return made;
}

TEST(CollectedTree, lets_points_wait_in_the_first_interval_on_their_way) {
    for (Square made : {Square{}, weighted_square()}) {
        CollectedTree tree = made.tree(0.1);
        const Descent root = root_of(made.cuts);
        const Entries at_root = tree.admit(root, {});
        EXPECT_NEAR(tree.weight_of(at_root), made.weight_in(0.4, 0.6, 0, 1), 1e-9);
        EXPECT_NEAR(tree.total_in(root.lower()).weight, made.weight_in(0, 0.4, 0, 1), 1e-9);
        EXPECT_NEAR(tree.total_in(root.upper().upper()).weight, made.weight_in(0.6, 1, 0.6, 1),
                    1e-9);
        auto [lower, upper] = tree.divide(Entries(at_root), plane_at(0, 0.45), {});
        const Entries below = tree.admit(root.lower(), lower);
        EXPECT_NEAR(tree.weight_of(below), made.weight_in(0, 0.45, 0.4, 0.6), 1e-9);
        tree.put_back(root.lower().node, Entries(below));
        tree.put_back(root.upper().node, tree.admit(root.upper(), upper));
        made.cuts.tree[0] = plane_at(0, 0.45);
        const std::vector<double> counted = tree.part_weights(root, {});
        tree.settle_rest();
        tree.write_parts();
        const std::vector<Part> parts = made.passes->parts();
        for (LocalIndex i = 0; i < 2000; ++i)
            ASSERT_EQ(parts[i], part_of(made.cuts, made.points().position(i)));
        const std::vector<double> expected{
            made.weight_in(0, 0.45, 0, 0.5), made.weight_in(0, 0.45, 0.5, 1),
            made.weight_in(0.45, 1, 0, 0.5), made.weight_in(0.45, 1, 0.5, 1)};
        for (std::size_t p = 0; p < 4; ++p) {
            EXPECT_NEAR(counted[p], expected[p], 1e-9);
            EXPECT_NEAR(tree.total_of(static_cast<Part>(p)).weight, expected[p], 1e-9);
        }
    }
}

TEST(CollectedTree, collects_more_where_a_cut_leaves_its_interval) {
    for (Square made : {Square{}, weighted_square()}) {
        CollectedTree tree = made.tree(0.05);
        const Descent root = root_of(made.cuts);
        const Entries before = tree.admit(root, {});
        const Bracket interval{-infinity, 0.45};
        const Entries more = tree.collect_more({&root, 1}, {&interval, 1})[0];
        EXPECT_NEAR(tree.weight_of(before) + tree.weight_of(more), made.weight_in(0, 0.55, 0, 1),
                    1e-9);
        EXPECT_NEAR(tree.total_in(root.lower()).weight, 0, 1e-9);
        EXPECT_NEAR(tree.total_in(root.upper()).weight, made.weight_in(0.55, 1, 0, 1), 1e-9);
        EXPECT_EQ(tree.total_in(root.lower()).count, 0);
    }
}

TEST(CollectedTree, finds_the_gap_about_a_cut_among_settled_points_too) {
    Square made;
    made.coordinates = {0.1, 0.5, 0.3, 0.9, 0.52, 0.2, 0.8, 0.1, 0.7, 0.9};
    CollectedTree tree = made.tree(0.05);
    const Descent root = root_of(made.cuts);
    const Entries entries = tree.admit(root, {});
    EXPECT_EQ(entries.size(), 1U);
    const Gap about = tree.gap_about(root, entries, plane_at(0, 0.5));
    EXPECT_EQ(about[0], -0.52);
    EXPECT_EQ(about[1], 0.3);
    const Gap above = tree.gap_about(root, entries, plane_at(0, 0.54));
    EXPECT_EQ(above[0], -0.7);
    EXPECT_EQ(above[1], 0.52);
}

TEST(CollectedTree, divides_a_lot_in_the_order_of_the_points) {
    const std::vector<double> x{1, 2, 1, 1, 0, 1};
    const std::vector<double> weights{1, 9, 2, 0, 9, 4};
    HostPasses passes(interleaved_points(x, 1, weights));
    CollectedTree tree(passes, test::all_collected(passes.points()));
    const Cut cut = plane_at(0, 1);
    const PointsInLot lot = tree.points_at(cut, {5, 4, 3, 2, 1, 0});
    EXPECT_EQ(lot.weight, 7);
    EXPECT_EQ(lot.first, 1);
    EXPECT_EQ(lot.last, 4);
    EXPECT_EQ(lot.before_last, 3);
    const auto [lower, upper] = tree.divide({5, 4, 3, 2, 1, 0}, cut, {0, 3, 0.5});
    EXPECT_EQ(lower, (Entries{0, 2, 3, 4}));
    EXPECT_EQ(upper, (Entries{1, 5}));
}

}  // namespace
}  // namespace rrcb
