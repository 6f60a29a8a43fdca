#include <rrcb/statistical_domain.hpp>
#include <rrcb/support_mesh.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace rrcb {
namespace {

CellMoments cell(double lower, double upper, GlobalCount count, double weight, double mean,
                 double deviation) {
    CellMoments moments;
    moments.box.lower = {lower, 0, 0};
    moments.box.upper = {upper, 0, 0};
    moments.moments = {count, weight, {mean, 0, 0}, {deviation, 0, 0}};
    return moments;
}

Box interval(double lower, double upper) {
    return {{lower, 0, 0}, {upper, 0, 0}};
}

/// Mean and deviation of a domain along an axis, in long double.
struct Spread {
    double mean;
    double deviation;
};

Spread spread_of(const StatisticalDomain& domain, std::size_t axis = 0) {
    using Number = long double;
    Number weight = 0;
    Number mean = 0;
    for (const Patch& patch : domain.patches) {
        weight += patch.weight;
        mean += patch.weight * (Number{patch.lower[axis]} / 2 + Number{patch.upper[axis]} / 2);
    }
    mean /= weight;
    Number square = 0;
    for (const Patch& patch : domain.patches) {
        const Number middle = Number{patch.lower[axis]} / 2 + Number{patch.upper[axis]} / 2 - mean;
        const Number half_width = Number{patch.upper[axis]} / 2 - Number{patch.lower[axis]} / 2;
        square += patch.weight * (middle * middle + half_width * half_width / 3) / weight;
    }
    return {static_cast<double>(mean), static_cast<double>(std::sqrt(square))};
}

TEST(AnalyticDomain, spreads_a_cell_over_root_three_deviations) {
    const std::vector<CellMoments> cells{cell(0, 10, 5, 5, 4, 1)};
    const StatisticalDomain domain = analytic_domain(cells, 1, interval(0, 10));
    ASSERT_EQ(domain.patches.size(), 1u);
    EXPECT_DOUBLE_EQ(domain.patches[0].lower[0], 4 - std::sqrt(3.0));
    EXPECT_DOUBLE_EQ(domain.patches[0].upper[0], 4 + std::sqrt(3.0));
    EXPECT_EQ(domain.patches[0].weight, 5);
}

TEST(AnalyticDomain, keeps_the_moments_of_points_near_a_face) {
    // sqrt(3) sigma is 4, twice the way to the face at 0. Weight 8 on [0, 2] and 2 on [2, 10] have
    // the mean (8 * 1 + 2 * 6) / 10 = 2 and the variance (8 * 2^2 / 3 + 2 * 8^2 / 3) / 10 = 4^2
    // / 3.
    const std::vector<CellMoments> cells{cell(0, 10, 5, 10, 2, 4 / std::sqrt(3.0))};
    const StatisticalDomain domain = analytic_domain(cells, 1, interval(-50, 50));
    ASSERT_EQ(domain.patches.size(), 2u);
    EXPECT_DOUBLE_EQ(domain.patches[0].lower[0], 0);
    EXPECT_DOUBLE_EQ(domain.patches[0].upper[0], 2);
    EXPECT_DOUBLE_EQ(domain.patches[0].weight, 8);
    EXPECT_DOUBLE_EQ(domain.patches[1].lower[0], 2);
    EXPECT_DOUBLE_EQ(domain.patches[1].upper[0], 10);
    EXPECT_DOUBLE_EQ(domain.patches[1].weight, 2);
    EXPECT_DOUBLE_EQ(spread_of(domain).mean, 2);
    EXPECT_DOUBLE_EQ(spread_of(domain).deviation, 4 / std::sqrt(3.0));
}

TEST(AnalyticDomain, mirrors_what_lies_near_the_other_face) {
    const std::vector<CellMoments> cells{cell(0, 10, 5, 10, 8, 4 / std::sqrt(3.0))};
    const StatisticalDomain domain = analytic_domain(cells, 1, interval(-50, 50));
    ASSERT_EQ(domain.patches.size(), 2u);
    EXPECT_DOUBLE_EQ(domain.patches[0].lower[0], 0);
    EXPECT_DOUBLE_EQ(domain.patches[0].upper[0], 8);
    EXPECT_DOUBLE_EQ(domain.patches[0].weight, 2);
    EXPECT_DOUBLE_EQ(domain.patches[1].upper[0], 10);
}

TEST(AnalyticDomain, keeps_one_box_that_hardly_leaves_the_cell) {
    // Moments of 3 points at 0, 1/4 and 1: a box that ended at the cell would have the mean 1/2.
    const double mean = 5.0 / 12;
    const double deviation = std::sqrt(13.0 / 72);
    ASSERT_LT(mean - std::sqrt(3.0) * deviation, 0);
    const std::vector<CellMoments> cells{cell(0, 1, 3, 3, mean, deviation)};
    const StatisticalDomain domain = analytic_domain(cells, 1, interval(-1, 2));
    ASSERT_EQ(domain.patches.size(), 1u);
    EXPECT_LT(domain.patches[0].lower[0], 0);
    EXPECT_DOUBLE_EQ(spread_of(domain).mean, mean);
    EXPECT_DOUBLE_EQ(spread_of(domain).deviation, deviation);
}

TEST(AnalyticDomain, never_leaves_the_box_of_all_points) {
    // Mean 4 and sqrt(3) sigma 4.4, little beyond the face at 0. 4.4^2 / 4 = 4.84.
    const std::vector<CellMoments> cells{cell(0, 10, 5, 5, 4, 4.4 / std::sqrt(3.0))};
    const StatisticalDomain domain = analytic_domain(cells, 1, interval(0, 30));
    ASSERT_EQ(domain.patches.size(), 2u);
    EXPECT_EQ(domain.patches[0].lower[0], 0);
    EXPECT_DOUBLE_EQ(domain.patches[1].upper[0], 8.84);
    EXPECT_EQ(analytic_domain(cells, 1, interval(-1, 30)).patches.size(), 1u);
    // The cube of a lattice may reach beyond the points.
    const StatisticalDomain in_a_cube = analytic_domain(cells, 1, interval(3, 30));
    ASSERT_EQ(in_a_cube.patches.size(), 2u);
    EXPECT_EQ(in_a_cube.patches[0].lower[0], 3);
    EXPECT_NEAR(in_a_cube.patches[1].upper[0], 4 + 4.4 * 4.4, 1e-14);
    EXPECT_NEAR(spread_of(in_a_cube).mean, 4, 1e-14);
    EXPECT_NEAR(spread_of(in_a_cube).deviation, 4.4 / std::sqrt(3.0), 1e-14);
}

TEST(AnalyticDomain, of_points_at_both_ends_leaves_the_cell_but_not_the_box_of_all) {
    const std::vector<CellMoments> cells{cell(0, 10, 2, 2, 5, 5)};
    const StatisticalDomain inside = analytic_domain(cells, 1, interval(-90, 20));
    ASSERT_EQ(inside.patches.size(), 1u);
    EXPECT_DOUBLE_EQ(inside.patches[0].lower[0], 5 - 5 * std::sqrt(3.0));
    EXPECT_DOUBLE_EQ(inside.patches[0].upper[0], 5 + 5 * std::sqrt(3.0));
    // 75 / 5 = 15 above the mean are too far, 75 / 12 = 6.25 are not.
    const StatisticalDomain at_a_face = analytic_domain(cells, 1, interval(0, 20));
    ASSERT_EQ(at_a_face.patches.size(), 2u);
    EXPECT_EQ(at_a_face.patches[0].lower[0], 0);
    EXPECT_NEAR(at_a_face.patches[1].upper[0], 20, 1e-14);
    EXPECT_NEAR(spread_of(at_a_face).deviation, 5, 1e-14);
    // Nothing as spread as this has room: the mean stays.
    const StatisticalDomain between = analytic_domain(cells, 1, interval(0, 12));
    EXPECT_EQ(between.patches.front().lower[0], 0);
    EXPECT_EQ(between.patches.back().upper[0], 12);
    EXPECT_DOUBLE_EQ(spread_of(between).mean, 5);
    EXPECT_DOUBLE_EQ(spread_of(between).deviation, std::sqrt(35.0 / 3));
}

TEST(AnalyticDomain, divides_along_each_axis_for_itself) {
    std::vector<CellMoments> cells{cell(0, 10, 5, 100, 2, 4 / std::sqrt(3.0))};
    cells[0].box = {{0, 0, 0}, {10, 10, 10}};
    cells[0].moments.mean = {2, 5, 8};
    cells[0].moments.deviation = {4 / std::sqrt(3.0), 1, 4 / std::sqrt(3.0)};
    const StatisticalDomain domain = analytic_domain(cells, 3, cells[0].box);
    ASSERT_EQ(domain.patches.size(), 4u);
    std::vector<double> weights;
    for (const Patch& patch : domain.patches) weights.push_back(patch.weight);
    std::sort(weights.begin(), weights.end());
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_DOUBLE_EQ(weights[i], (std::array<double, 4>{4, 16, 16, 64}[i]));
    for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_DOUBLE_EQ(spread_of(domain, a).mean, cells[0].moments.mean[a]);
        EXPECT_DOUBLE_EQ(spread_of(domain, a).deviation, cells[0].moments.deviation[a]);
    }
}

TEST(AnalyticDomain, keeps_the_moments_of_skewed_points_on_any_mesh) {
    std::mt19937_64 engine(1);
    std::vector<double> x(3000);
    for (double& coordinate : x) coordinate = std::pow(static_cast<double>(engine()) * 0x1p-64, 4);
    const Points points = interleaved_points(x, 3);
    const Box box = bounding_box(points);
    for (const int mesh : {1, 2, 5}) {
        const auto cells = cell_moments(points, make_support_mesh(box, 3, mesh));
        for (const CellMoments& cell : cells) {
            const StatisticalDomain domain = analytic_domain(std::span(&cell, 1), 3, box);
            for (std::size_t a = 0; a < 3; ++a) {
                EXPECT_NEAR(spread_of(domain, a).mean, cell.moments.mean[a], 1e-15);
                EXPECT_LE(spread_of(domain, a).deviation, cell.moments.deviation[a] * (1 + 1e-12));
            }
        }
    }
}

TEST(AnalyticDomain, survives_extreme_coordinates) {
    constexpr double largest = std::numeric_limits<double>::max();
    for (const double size : {1e-310, 1e-300, 1e300, largest}) {
        for (const double mean : {-size, -0.9 * size, 0.0, 0.5 * size, size}) {
            for (const double deviation : {0.0, 1e-9 * size, 0.1 * size, 0.5 * size, size}) {
                const std::vector<CellMoments> cells{cell(-size, size, 5, 5, mean, deviation)};
                const StatisticalDomain domain = analytic_domain(cells, 1, interval(-size, size));
                double weight = 0;
                for (const Patch& patch : domain.patches) {
                    EXPECT_LE(patch.lower[0], patch.upper[0]);
                    EXPECT_LE(std::max(-patch.lower[0], patch.upper[0]), size);
                    EXPECT_GE(patch.weight, 0);
                    weight += patch.weight;
                }
                EXPECT_DOUBLE_EQ(weight, 5);
            }
        }
    }
    const std::vector<CellMoments> cells{cell(-1e300, 1e300, 5, 5, -9e299, 1e299)};
    const StatisticalDomain domain = analytic_domain(cells, 1, interval(-1e300, 1e300));
    EXPECT_DOUBLE_EQ(spread_of(domain).mean, -9e299);
    EXPECT_DOUBLE_EQ(spread_of(domain).deviation, 1e299);
}

TEST(AnalyticDomain, without_extent_is_a_point) {
    const std::vector<CellMoments> cells{cell(3, 3, 5, 5, 3, 0), cell(0, 10, 5, 5, 10, 0)};
    const StatisticalDomain domain = analytic_domain(cells, 1, interval(0, 10));
    ASSERT_EQ(domain.patches.size(), 2u);
    EXPECT_EQ(domain.patches[0].lower[0], 3);
    EXPECT_EQ(domain.patches[0].upper[0], 3);
    EXPECT_EQ(domain.patches[1].lower[0], 10);
    EXPECT_EQ(domain.patches[1].upper[0], 10);
}

TEST(AnalyticDomain, a_uniform_cell_is_restored) {
    const std::vector<CellMoments> cells{cell(2, 6, 100, 100, 4, 4 / std::sqrt(12.0))};
    const StatisticalDomain domain = analytic_domain(cells, 1, interval(2, 6));
    ASSERT_EQ(domain.patches.size(), 1u);
    EXPECT_NEAR(domain.patches[0].lower[0], 2, 1e-14);
    EXPECT_NEAR(domain.patches[0].upper[0], 6, 1e-14);
}

TEST(AnalyticDomain, counts_stand_in_where_all_weights_are_zero) {
    const std::vector<CellMoments> cells{cell(0, 1, 3, 0, 0.5, 0), cell(1, 2, 1, 0, 1.5, 0)};
    const StatisticalDomain domain = analytic_domain(cells, 1, interval(0, 2));
    EXPECT_EQ(domain.patches[0].weight, 3);
    EXPECT_EQ(domain.patches[1].weight, 1);
}

TEST(SampledDomain, shares_points_by_largest_remainder) {
    // 10 * (5, 3, 1) / 9 = 5.56, 3.33, 1.11: the point left over goes to the first cell.
    const std::vector<CellMoments> cells{cell(0, 1, 5, 5, 0, 0), cell(0, 1, 3, 3, 1, 0),
                                         cell(0, 1, 1, 1, 2, 0)};
    Options options;
    options.sample_fraction = 1;
    std::vector<CellMoments> ten = cells;
    ten[2].moments.count = 2;  // 10 points in all, weights unchanged
    const StatisticalDomain domain = sampled_domain(ten, 1, options);
    ASSERT_EQ(domain.points.size(), 10u);
    std::vector<int> counts(3);
    for (const MassPoint& point : domain.points)
        ++counts[static_cast<std::size_t>(point.position[0])];
    EXPECT_EQ(counts, (std::vector<int>{6, 3, 1}));
}

TEST(SampledDomain, draws_the_fraction_asked_for_within_the_multiplier) {
    const std::vector<CellMoments> cells{cell(0, 1, 1000, 1000, 0.5, 0.1)};
    Options options;
    options.sample_fraction = 0.125;
    options.sigma_multiplier = 2;
    const StatisticalDomain domain = sampled_domain(cells, 1, options);
    ASSERT_EQ(domain.points.size(), 125u);
    double mean = 0;
    for (const MassPoint& point : domain.points) {
        EXPECT_GE(point.position[0], 0.5 - 0.2);
        EXPECT_LT(point.position[0], 0.5 + 0.2);
        mean += point.position[0] / 125;
    }
    EXPECT_NEAR(mean, 0.5, 4 * 0.4 / std::sqrt(12.0 * 125));
}

TEST(SampledDomain, the_seed_decides_the_points) {
    const std::vector<CellMoments> cells{cell(0, 1, 50, 50, 0.5, 0.1)};
    const auto first_point = [&](std::uint64_t seed) {
        Options options;
        options.seed = seed;
        return sampled_domain(cells, 1, options).points[0].position[0];
    };
    EXPECT_EQ(first_point(1), first_point(1));
    EXPECT_NE(first_point(1), first_point(2));
    // First output of the 64-bit Mersenne Twister with seed 5489 (ISO C++ [rand.predef] engine).
    const double u = static_cast<double>(14514284786278117030u >> 11) * 0x1p-53;
    EXPECT_DOUBLE_EQ(first_point(5489), 0.35 + 0.3 * u);
}

TEST(SampledDomain, of_no_cells_is_empty) {
    EXPECT_TRUE(sampled_domain({}, 2, {}).points.empty());
}

TEST(PointDomain, holds_each_point_with_its_weight) {
    const std::vector<double> coordinates{1, 2, 3, 4};
    const std::vector<double> weights{5, 6};
    const StatisticalDomain domain = point_domain(interleaved_points(coordinates, 2, weights));
    ASSERT_EQ(domain.points.size(), 2u);
    EXPECT_EQ(domain.points[1].position, (Vector{3, 4, 0}));
    EXPECT_EQ(domain.points[1].weight, 6);
}

}  // namespace
}  // namespace rrcb
