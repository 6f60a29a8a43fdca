#include "../support/clouds.hpp"

#include <rrcb/bisection.hpp>
#include <rrcb/cuts.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// x = 4 first; below it y = 1; above it y = 3 for two parts more.
Cuts four_quarters() {
    Cuts cuts{2, 4, {}};
    cuts.tree = {{0, 0, {4, -infinity, -infinity}},
                 {1, 0, {-infinity, 1, -infinity}},
                 {1, 0, {-infinity, 3, -infinity}}};
    return cuts;
}

Box box_2d(double x0, double y0, double x1, double y1) {
    Box box;
    box.lower = {x0, y0, 0};
    box.upper = {x1, y1, 0};
    return box;
}

TEST(Cuts, a_point_on_a_cut_is_above_it) {
    const Cuts cuts = four_quarters();
    EXPECT_EQ(part_of(cuts, {4, 2, 0}), 2);
    EXPECT_EQ(part_of(cuts, {4, 3, 0}), 3);
    EXPECT_EQ(part_of(cuts, {3.9, 1, 0}), 1);
    EXPECT_EQ(part_of(cuts, {3.9, 0.9, 0}), 0);
}

TEST(Cuts, ties_are_broken_along_the_other_axes) {
    const Cut cut{1, 0, {5, 2, 7}};
    EXPECT_TRUE(is_above(cut, {0, 2.1, 0}, 3));
    EXPECT_FALSE(is_above(cut, {9, 1.9, 9}, 3));
    EXPECT_TRUE(is_above(cut, {6, 2, 0}, 3));
    EXPECT_FALSE(is_above(cut, {4, 2, 9}, 3));
    EXPECT_TRUE(is_above(cut, {5, 2, 7}, 3));
    EXPECT_FALSE(is_above(cut, {5, 2, 6}, 3));
    EXPECT_TRUE(is_above(cut, {5, 2, 0}, 2));
}

TEST(Cuts, box_of_a_part_is_open_outwards) {
    const Cuts cuts = four_quarters();
    const Box box = box_of(cuts, 2);
    EXPECT_EQ(box.lower[0], 4);
    EXPECT_EQ(box.upper[0], infinity);
    EXPECT_EQ(box.lower[1], -infinity);
    EXPECT_EQ(box.upper[1], 3);
}

TEST(Cuts, a_box_touches_both_sides_of_a_cut_that_divides_the_points_in_it) {
    Cuts cuts{2, 2, {{0, 0, {4, 2, -infinity}}}};
    EXPECT_EQ(parts_touching(cuts, box_2d(4, 2, 4, 2)), (std::vector<Part>{1}));
    cuts.tree[0].divides = 1;
    EXPECT_EQ(parts_touching(cuts, box_2d(4, 2, 4, 2)), (std::vector<Part>{0, 1}));
    EXPECT_EQ(parts_touching(cuts, box_2d(4, 2.5, 5, 3)), (std::vector<Part>{1}));
}

TEST(Cuts, a_box_touches_the_parts_it_reaches_into) {
    const Cuts cuts = four_quarters();
    EXPECT_EQ(parts_touching(cuts, box_2d(0, 0, 1, 0.5)), (std::vector<Part>{0}));
    EXPECT_EQ(parts_touching(cuts, box_2d(0, 0, 1, 1)), (std::vector<Part>{0, 1}));
    EXPECT_EQ(parts_touching(cuts, box_2d(3, 0, 4, 2)), (std::vector<Part>{0, 1, 2}));
    EXPECT_EQ(parts_touching(cuts, box_2d(-9, -9, 9, 9)), (std::vector<Part>{0, 1, 2, 3}));
    EXPECT_TRUE(parts_touching(cuts, Box{}).empty());
}

TEST(Cuts, all_look_ups_agree_on_points_on_and_off_the_cuts) {
    std::vector<double> cloud = test::uniform_cloud(400, 3, 31);
    for (double& x : cloud) x = std::floor(x * 6);  // many ties
    for (const auto dimension : {1, 2, 3}) {
        const Points points = interleaved_points(cloud, dimension);
        const Cuts cuts = bisect(point_domain(points), 7, {}, CutRule::weighted_fraction).cuts;
        std::vector<Part> parts(points.count);
        assign(cuts, points, parts);
        for (LocalIndex i = 0; i < points.count; ++i) {
            const Vector x = points.position(i);
            EXPECT_EQ(parts[i], part_of(cuts, x));
            const std::vector<Part> touched = parts_touching(cuts, {x, x});
            EXPECT_EQ(touched, std::vector<Part>{parts[i]});
            const Box box = box_of(cuts, parts[i]);
            for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
                EXPECT_GE(x[a], box.lower[a]);
                EXPECT_LE(x[a], box.upper[a]);
            }
        }
    }
}

TEST(Cuts, columns_and_interleaved_points_are_assigned_alike) {
    const std::vector<double> cloud = test::uniform_cloud(100, 2, 37);
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t i = 0; i < cloud.size(); i += 2) {
        x.push_back(cloud[i]);
        y.push_back(cloud[i + 1]);
    }
    const std::array<std::span<const double>, 2> columns{x, y};
    const Points points = interleaved_points(cloud, 2);
    const Cuts cuts = bisect(point_domain(points), 5, {}, CutRule::weighted_fraction).cuts;
    std::vector<Part> a(100);
    std::vector<Part> b(100);
    assign(cuts, points, a);
    assign(cuts, column_points(columns), b);
    EXPECT_EQ(a, b);
}

TEST(Cuts, a_part_of_size_zero_has_no_points_and_an_empty_box) {
    const std::vector<double> cloud = test::uniform_cloud(100, 2, 41);
    const Points points = interleaved_points(cloud, 2);
    const std::vector<double> sizes{0, 1, 1};
    const Cuts cuts = bisect(point_domain(points), 3, sizes, CutRule::weighted_fraction).cuts;
    std::vector<Part> parts(100);
    assign(cuts, points, parts);
    for (const Part part : parts) EXPECT_NE(part, 0);
    const Box box = box_of(cuts, 0);
    EXPECT_FALSE(box.lower[0] < box.upper[0] && box.lower[1] < box.upper[1]);
}

TEST(Cuts, one_part_takes_everything) {
    EXPECT_EQ(part_of({2, 1, {}}, {1e300, -1e300, 0}), 0);
    EXPECT_EQ(box_of({2, 1, {}}, 0).lower[1], -infinity);
}

}  // namespace
}  // namespace rrcb
