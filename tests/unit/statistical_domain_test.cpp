#include <rrcb/statistical_domain.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
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

TEST(AnalyticDomain, spreads_a_cell_over_root_three_deviations) {
    const std::vector<CellMoments> cells{cell(0, 10, 5, 5, 4, 1)};
    const StatisticalDomain domain = analytic_domain(cells, 1);
    ASSERT_EQ(domain.patches.size(), 1u);
    EXPECT_DOUBLE_EQ(domain.patches[0].lower[0], 4 - std::sqrt(3.0));
    EXPECT_DOUBLE_EQ(domain.patches[0].upper[0], 4 + std::sqrt(3.0));
    EXPECT_EQ(domain.patches[0].weight, 5);
}

TEST(AnalyticDomain, stays_inside_the_cell) {
    const std::vector<CellMoments> cells{cell(0, 10, 2, 2, 5, 5)};
    const StatisticalDomain domain = analytic_domain(cells, 1);
    EXPECT_EQ(domain.patches[0].lower[0], 0);
    EXPECT_EQ(domain.patches[0].upper[0], 10);
}

TEST(AnalyticDomain, a_uniform_cell_is_restored) {
    const std::vector<CellMoments> cells{cell(2, 6, 100, 100, 4, 4 / std::sqrt(12.0))};
    const StatisticalDomain domain = analytic_domain(cells, 1);
    EXPECT_NEAR(domain.patches[0].lower[0], 2, 1e-14);
    EXPECT_NEAR(domain.patches[0].upper[0], 6, 1e-14);
}

TEST(AnalyticDomain, counts_stand_in_where_all_weights_are_zero) {
    const std::vector<CellMoments> cells{cell(0, 1, 3, 0, 0.5, 0), cell(1, 2, 1, 0, 1.5, 0)};
    const StatisticalDomain domain = analytic_domain(cells, 1);
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
    ASSERT_EQ(domain.patches.size(), 10u);
    std::vector<int> counts(3);
    for (const Patch& patch : domain.patches) ++counts[static_cast<std::size_t>(patch.lower[0])];
    EXPECT_EQ(counts, (std::vector<int>{6, 3, 1}));
}

TEST(SampledDomain, draws_the_fraction_asked_for_within_the_multiplier) {
    const std::vector<CellMoments> cells{cell(0, 1, 1000, 1000, 0.5, 0.1)};
    Options options;
    options.sample_fraction = 0.125;
    options.sigma_multiplier = 2;
    const StatisticalDomain domain = sampled_domain(cells, 1, options);
    ASSERT_EQ(domain.patches.size(), 125u);
    double mean = 0;
    for (const Patch& patch : domain.patches) {
        EXPECT_EQ(patch.lower, patch.upper);
        EXPECT_GE(patch.lower[0], 0.5 - 0.2);
        EXPECT_LT(patch.lower[0], 0.5 + 0.2);
        mean += patch.lower[0] / 125;
    }
    EXPECT_NEAR(mean, 0.5, 4 * 0.4 / std::sqrt(12.0 * 125));
}

TEST(SampledDomain, the_seed_decides_the_points) {
    const std::vector<CellMoments> cells{cell(0, 1, 50, 50, 0.5, 0.1)};
    const auto first_point = [&](std::uint64_t seed) {
        Options options;
        options.seed = seed;
        return sampled_domain(cells, 1, options).patches[0].lower[0];
    };
    EXPECT_EQ(first_point(1), first_point(1));
    EXPECT_NE(first_point(1), first_point(2));
    // First output of the 64-bit Mersenne Twister with seed 5489 (ISO C++ [rand.predef] engine).
    const double u = static_cast<double>(14514284786278117030u >> 11) * 0x1p-53;
    EXPECT_DOUBLE_EQ(first_point(5489), 0.35 + 0.3 * u);
}

TEST(SampledDomain, of_no_cells_is_empty) {
    EXPECT_TRUE(sampled_domain({}, 2, {}).patches.empty());
}

TEST(PointDomain, holds_each_point_with_its_weight) {
    const std::vector<double> coordinates{1, 2, 3, 4};
    const std::vector<double> weights{5, 6};
    const StatisticalDomain domain = point_domain(interleaved_points(coordinates, 2, weights));
    ASSERT_EQ(domain.patches.size(), 2u);
    EXPECT_EQ(domain.patches[1].lower, (Vector{3, 4, 0}));
    EXPECT_EQ(domain.patches[1].upper, (Vector{3, 4, 0}));
    EXPECT_EQ(domain.patches[1].weight, 6);
}

}  // namespace
}  // namespace rrcb
