// Numbers of points of bodies, counted by hand: cells of 0.5 m with 2 points along each axis, so
// points at 0.125, 0.375, 0.625, ... m from the lower corner of the domain.
#include "scene/lattice.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

namespace mpm::test {
namespace {

Scene scene_with(int dimension, const std::vector<Region>& bodies, const Vector& lower) {
    Scene scene{
        .name = "bodies",
        .dimension = dimension,
        .grid = {.lower = lower, .spacing = 0.5, .num_cells = {8, 8, dimension == 3 ? 8 : 0}},
        .materials = {elastic_material("rubber", 1000, 1e6, 0.3)},
        .bodies = {}};
    for (const Region& region : bodies)
        scene.bodies.push_back({.contains = region,
                                .points_per_cell = {2, 2, dimension == 3 ? 2 : 1},
                                .material = "rubber"});
    return scene;
}

std::int64_t num_points(int dimension, const std::vector<Region>& bodies,
                        const Vector& lower = {}) {
    return scene_points(scene_with(dimension, bodies, lower)).num_points;
}

TEST(Body, in_two_dimensions_takes_points_on_its_lower_sides_only) {
    const auto box = [](double begin, double end) {
        return num_points(2, {box_region({{begin, begin}, {end, end}})});
    };
    EXPECT_EQ(box(0, 1), 16);          // sides midway between points: 0.125 ... 0.875
    EXPECT_EQ(box(0.125, 1.125), 16);  // both on points: 0.125 ... 0.875
    EXPECT_EQ(box(0.125, 1), 16);      // the lower ones on points: 0.125 ... 0.875
    EXPECT_EQ(box(0, 1.125), 16);      // the upper ones: 0.125 ... 0.875
    EXPECT_EQ(box(0.2, 1.2), 16);      // between: 0.375 ... 1.125
    EXPECT_EQ(box(0.124, 1.126), 25);  // a hair wider than from point to point
    EXPECT_EQ(box(0.126, 1.124), 9);   // a hair narrower: 0.375 ... 0.875
    EXPECT_EQ(box(3.125, 4.125), 16);  // beyond the domain's upper corner: 3.125 ... 3.875
}

TEST(Body, in_three_dimensions_takes_points_on_its_lower_sides_only) {
    const auto box = [](double begin, double end) {
        return num_points(3, {box_region({{begin, begin, begin}, {end, end, end}})});
    };
    EXPECT_EQ(box(0, 1), 64);
    EXPECT_EQ(box(0.125, 1.125), 64);
    EXPECT_EQ(box(0.124, 1.126), 125);
    EXPECT_EQ(box(0.126, 1.124), 27);
    EXPECT_EQ(num_points(3, {box_region({{0.125, 0, 0.25}, {1.125, 1, 1.125}})}), 4 * 4 * 3);
}

// Far from the origin the sides and the points on them differ by rounding.
TEST(Body, takes_the_same_points_in_domains_with_an_offset) {
    for (const double offset : {-0.1, 0.3, 1234.7, -5e6 + 0.1}) {
        const double begin = offset + 0.125, end = offset + 1.125;
        EXPECT_EQ(num_points(2, {box_region({{begin, begin}, {end, end}})}, {offset, offset}), 16)
            << offset;
        EXPECT_EQ(num_points(3, {box_region({{begin, begin, begin}, {end, end, end}})},
                             {offset, offset, offset}),
                  64)
            << offset;
    }
}

// A square from point to point, cut along a diagonal that runs through points: i + j < 4 of i, j =
// 0
// ... 3 are 4 + 3 + 2 + 1, the rest are 6; i < j are 6, the rest with the diagonal 10.
TEST(Body, by_polygons_shares_no_point_with_another_that_touches_it) {
    constexpr double a = 0.125, b = 1.125;
    const auto polygon = [](int dimension, std::vector<Vector> corners) {
        const Region prism = polygon_region(std::move(corners));
        return num_points(dimension, {common_to(prism, box_region({{0, 0, 0}, {2, 2, 1.125}}))});
    };
    for (const auto& [dimension, layers] : {std::pair(2, 1), std::pair(3, 4)}) {
        EXPECT_EQ(polygon(dimension, {{a, a}, {b, a}, {b, b}, {a, b}}), 16 * layers);
        EXPECT_EQ(polygon(dimension, {{a, a}, {b, a}, {a, b}}), 10 * layers);
        EXPECT_EQ(polygon(dimension, {{b, a}, {b, b}, {a, b}}), 6 * layers);
        EXPECT_EQ(polygon(dimension, {{a, a}, {b, b}, {a, b}}) +
                      polygon(dimension, {{a, a}, {b, a}, {b, b}}),
                  16 * layers);
    }
    // An L of three such squares, in both directions of its corners.
    constexpr double c = 2.125;
    const std::vector<Vector> l{{a, a}, {c, a}, {c, b}, {b, b}, {b, c}, {a, c}};
    EXPECT_EQ(num_points(2, {polygon_region(l)}), 48);
    EXPECT_EQ(num_points(2, {polygon_region({l.rbegin(), l.rend()})}), 48);
}

// Of the 13 points up to two spacings away, two are on the upper rim, along x and along y.
TEST(Body, by_a_ball_takes_points_on_its_lower_rim_only) {
    EXPECT_EQ(num_points(2, {ball_region({1.125, 1.125}, 0.5)}), 11);
    EXPECT_EQ(num_points(3, {ball_region({1.125, 1.125, 1.125}, 0.5)}), 33 - 3);
}

TEST(Body, shares_no_point_with_a_body_whose_shape_is_cut_out) {
    const Region block = box_region({{0, 0}, {2, 2}}), ball = ball_region({1.125, 1.125}, 0.5);
    const Region half = half_space_region({1.125, 0}, {1, 1});
    EXPECT_EQ(num_points(2, {without(block, ball), ball}), 64);
    EXPECT_EQ(num_points(2, {without(block, half), common_to(block, half)}), 64);
}

}  // namespace
}  // namespace mpm::test
