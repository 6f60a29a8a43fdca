#include "bisection/weighted_quantile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

StatisticalDomain domain_of(const std::vector<Patch>& patches, int dimension = 1) {
    return {dimension, patches, {}};
}

double quantile(const std::vector<Patch>& patches, double target) {
    return weighted_quantile(domain_of(patches), 0, target, false).at[0];
}

TEST(WeightedQuantile, divides_a_patch_in_the_ratio_of_the_weights) {
    EXPECT_EQ(quantile({{{0}, {4}, 8}}, 2), 1);
    EXPECT_EQ(quantile({{{0}, {4}, 8}, {{4}, {5}, 4}}, 10), 4.5);
    EXPECT_EQ(quantile({{{0}, {4}, 4}, {{2}, {6}, 4}}, 4), 3);  // where they overlap
}

TEST(WeightedQuantile, lies_in_the_middle_of_a_gap_with_the_target_below_it) {
    EXPECT_EQ(quantile({{{0}, {1}, 1}, {{3}, {4}, 1}}, 1), 2);
    EXPECT_EQ(quantile({{{0}, {1}, 0.1}, {{0}, {1}, 0.2}, {{3}, {4}, 1}}, 0.3), 2);
}

TEST(WeightedQuantile, leaves_a_jump_on_the_nearer_side) {
    const std::vector<Patch> patches{{{0}, {1}, 1}, {{2}, {2}, 4}, {{3}, {4}, 1}};
    EXPECT_EQ(quantile(patches, 2), 2);    // 1 of 4: above
    EXPECT_EQ(quantile(patches, 4), 2.5);  // 3 of 4: below, in the gap behind it
}

TEST(WeightedQuantile, divides_a_jump_along_the_other_axes_unless_it_is_to_be_plain) {
    const StatisticalDomain domain = domain_of({{{2, 0}, {2, 4}, 8}}, 2);
    const Cut cut = weighted_quantile(domain, 0, 2, false);
    EXPECT_EQ(cut.at[0], 2);
    EXPECT_EQ(cut.at[1], 1);
    const Cut plain = weighted_quantile(domain, 0, 2, true);
    EXPECT_EQ(plain.at[1], -infinity);
}

TEST(WeightedQuantile, passes_over_patches_without_weight) {
    EXPECT_EQ(quantile({{{-9}, {-8}, 0}, {{0}, {4}, 8}, {{9}, {9}, 0}}, 2), 1);
}

TEST(FractionBelow, is_that_of_the_extent_over_the_whole_range_of_a_double) {
    constexpr double largest = std::numeric_limits<double>::max();
    EXPECT_EQ(fraction_below(0, 1, 4), 0.25);
    EXPECT_EQ(fraction_below(-largest, 0, largest), 0.5);
}

}  // namespace
}  // namespace rrcb
