// Open points on their way down a tree, against looking at every point.
#include "../support/all_collected.hpp"
#include "../support/clouds.hpp"
#include "passes/host_passes.hpp"
#include "passes/open_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
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
    Cuts cuts{2, 4, {plane_at(0, 0.5), plane_at(1, 0.5), plane_at(1, 0.5)}, {}};
    std::optional<HostPasses> passes{};
    OpenMemory memory{};

    Points points() const { return Points(coordinates, 2, weights); }
    std::unique_ptr<OpenPoints> open(double width) {
        const std::vector<Bracket> intervals(3, {0.5 - width, 0.5 + width});
        passes.emplace(points());
        passes->summary(true);
        return open_points(*passes, cuts, intervals, false, memory);
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

/// Returns the weight of the candidates of a node.
double weight_chosen(const OpenPoints& open, const Descent& at) {
    std::vector<double> records;
    open.take(at, records);
    double weight = 0;
    for (std::size_t k = 2; k < records.size(); k += 3) weight += records[k];
    return weight;
}

TEST(OpenPoints, wait_in_the_first_interval_on_their_way) {
    for (Square made : {Square{}, weighted_square()}) {
        const auto open = made.open(0.1);
        const Descent root = root_of(made.cuts);
        EXPECT_NEAR(open->weight_at(root), made.weight_in(0.4, 0.6, 0, 1), 1e-9);
        EXPECT_NEAR(open->total_in(root.lower()).weight, made.weight_in(0, 0.4, 0, 1), 1e-9);
        EXPECT_NEAR(open->total_in(root.upper().upper()).weight, made.weight_in(0.6, 1, 0.6, 1),
                    1e-9);
        made.cuts.tree[0] = plane_at(0, 0.45);
        open->cut(root, made.cuts.tree[0], {});
        EXPECT_TRUE(open->is_empty(root));
        EXPECT_NEAR(open->weight_at(root.lower()), made.weight_in(0, 0.45, 0.4, 0.6), 1e-9);
        const std::vector<double> settled = open->settle();
        const std::vector<Part> parts = made.passes->parts();
        for (LocalIndex i = 0; i < 2000; ++i)
            ASSERT_EQ(parts[i], part_of(made.cuts, made.points().position(i)));
        const std::vector<double> expected{
            made.weight_in(0, 0.45, 0, 0.5), made.weight_in(0, 0.45, 0.5, 1),
            made.weight_in(0.45, 1, 0, 0.5), made.weight_in(0.45, 1, 0.5, 1)};
        for (std::size_t p = 0; p < 4; ++p) {
            EXPECT_NEAR(settled[p], expected[p], 1e-9);
        }
    }
}

TEST(OpenPoints, are_counted_and_taken_as_they_are_chosen) {
    Square made = weighted_square();
    const auto open = made.open(0.1);
    const Descent root = root_of(made.cuts);
    EXPECT_NEAR(weight_chosen(*open, root), open->weight_at(root), 1e-9);
    open->choose(root, 0, {0.45, infinity});
    open->choose(root, 0, {-infinity, 0.5});
    EXPECT_NEAR(weight_chosen(*open, root), made.weight_in(0.45, 0.5, 0, 1), 1e-9);
    EXPECT_NEAR(open->weight_at(root), made.weight_in(0.4, 0.6, 0, 1), 1e-9);
    const HistogramLayout layout{.num_bins = 2};
    std::vector<double> histogram(layout.length());
    clear_histogram(histogram);
    open->count(root, 0, {0.4, 0.5, false, 2}, layout, histogram);
    EXPECT_NEAR(weights_in(histogram, layout)[2], made.weight_in(0.45, 0.5, 0, 1), 1e-9);
    std::vector<double> sums(2 * layout.num_slots());
    open->count_sums(root, 0, {0.4, 0.5, false, 2}, layout, sums);
    EXPECT_EQ(sums[2], weights_in(histogram, layout)[2]);
}

TEST(OpenPoints, are_more_if_a_cut_leaves_its_interval) {
    for (Square made : {Square{}, weighted_square()}) {
        const auto open = made.open(0.05);
        const Descent root = root_of(made.cuts);
        open->choose(root, 0, {-infinity, 0.45});
        const WiderNode wider{root, {-infinity, 0.45}};
        open->widen({&wider, 1});
        EXPECT_NEAR(weight_chosen(*open, root), made.weight_in(0, 0.45, 0, 1), 1e-9);
        EXPECT_NEAR(open->weight_at(root), made.weight_in(0, 0.55, 0, 1), 1e-9);
        EXPECT_NEAR(open->total_in(root.lower()).weight, 0, 1e-9);
        EXPECT_NEAR(open->total_in(root.upper()).weight, made.weight_in(0.55, 1, 0, 1), 1e-9);
        EXPECT_EQ(open->total_in(root.lower()).count, 0);
    }
}

TEST(OpenPoints, have_a_gap_about_a_cut_among_settled_points_too) {
    Square made;
    made.coordinates = {0.1, 0.5, 0.3, 0.9, 0.52, 0.2, 0.8, 0.1, 0.7, 0.9};
    const auto open = made.open(0.05);
    const Descent root = root_of(made.cuts);
    EXPECT_EQ(open->weight_at(root), 1);
    const Gap about = open->gap(root, plane_at(0, 0.5));
    EXPECT_EQ(about[0], -0.52);
    EXPECT_EQ(about[1], 0.3);
    const Gap above = open->gap(root, plane_at(0, 0.54));
    EXPECT_EQ(above[0], -0.7);
    EXPECT_EQ(above[1], 0.52);
}

TEST(OpenPoints, of_a_tree_without_cuts_divide_a_lot_in_their_order) {
    const std::vector<double> x{1, 2, 1, 1, 0, 1};
    const std::vector<double> weights{1, 9, 2, 0, 9, 4};
    HostPasses passes(Points(x, 1, weights), std::vector<Part>(6));
    const auto open = test::all_open(passes, 2);
    const Descent root = root_of(2, {});
    EXPECT_EQ(open->weight_at(root), 25);
    EXPECT_EQ(open->total_in(root).count, 0);
    const Cut cut = plane_at(0, 1);
    const PointsInLot lot = open->lot(root, cut);
    EXPECT_EQ(lot.weight, 7);
    EXPECT_EQ(lot.first, 1);
    EXPECT_EQ(lot.last, 4);
    EXPECT_EQ(lot.before_last, 3);
    EXPECT_EQ(open->gap(root, cut)[1], 0);
    open->cut(root, cut, {0, 3, 0.5});
    EXPECT_EQ(open->weight_at(root.lower()), 12);
    EXPECT_EQ(open->weight_at(root.upper()), 13);
    EXPECT_EQ(open->settle(), (std::vector<double>{12, 13}));
    EXPECT_EQ(passes.parts(), (std::vector<Part>{0, 1, 0, 0, 0, 1}));
}

}  // namespace
}  // namespace rrcb
