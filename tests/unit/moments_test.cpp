#include "../support/clouds.hpp"
#include "moments_reference.hpp"

#include <rrcb/detail/moments.hpp>

namespace rrcb {
namespace {

using test::expect_reference_moments;

TEST(Moments, of_four_points_worked_out_by_hand) {
    const std::vector<double> x{0, 1, 4, 5};
    const Points points(x, 1);
    const auto cells = cell_moments(points, make_support_mesh(bounding_box(points), 1, 1));
    ASSERT_EQ(cells.size(), 1u);
    EXPECT_EQ(cells[0].moments.count, 4);
    EXPECT_EQ(cells[0].moments.weight, 4);
    EXPECT_DOUBLE_EQ(cells[0].moments.mean[0], 2.5);
    EXPECT_DOUBLE_EQ(cells[0].moments.deviation[0], std::sqrt(17.0 / 4));
}

TEST(Moments, weights_count_like_repeated_points) {
    const std::vector<double> x{0, 4};
    const std::vector<double> weights{3, 1};
    const Points points(x, 1, weights);
    const auto cells = cell_moments(points, make_support_mesh(bounding_box(points), 1, 1));
    EXPECT_EQ(cells[0].moments.count, 2);
    EXPECT_EQ(cells[0].moments.weight, 4);
    EXPECT_DOUBLE_EQ(cells[0].moments.mean[0], 1);
    EXPECT_DOUBLE_EQ(cells[0].moments.deviation[0], std::sqrt(3.0));
}

TEST(Moments, match_long_double_for_every_dimension_and_mesh) {
    for (const int dimension : {1, 2, 3})
        for (const int cells : {1, 2, 5})
            expect_reference_moments(Points(test::uniform_cloud(3000, dimension, 7), dimension),
                                     cells);
}

TEST(Moments, survive_extreme_weights) {
    for (const double magnitude : {5e-324, 1e-300, 1e300}) {
        const std::vector<double> x{0, 4e6};
        const std::vector<double> weights{3 * magnitude, magnitude};
        const Points points(x, 1, weights);
        const auto cells = cell_moments(points, make_support_mesh(bounding_box(points), 1, 1));
        EXPECT_EQ(cells[0].moments.weight, 3 * magnitude + magnitude);
        EXPECT_DOUBLE_EQ(cells[0].moments.mean[0], 1e6);
        EXPECT_DOUBLE_EQ(cells[0].moments.deviation[0], 1e6 * std::sqrt(3.0));
    }
}

TEST(Moments, cells_without_weight_are_left_out) {
    const std::vector<double> x{0, 1, 2};
    const std::vector<double> weights{1, 0, 1};
    const Points points(x, 1, weights);
    const auto cells = cell_moments(points, make_support_mesh(bounding_box(points), 1, 3));
    ASSERT_EQ(cells.size(), 2u);
    EXPECT_EQ(cells[0].cell, 0u);
    EXPECT_EQ(cells[1].cell, 2u);
}

TEST(Moments, without_any_weight_are_those_of_the_positions) {
    const std::vector<double> x{0, 2};
    const std::vector<double> weights{0, 0};
    const Points points(x, 1, weights);
    const auto cells = cell_moments(points, make_support_mesh(bounding_box(points), 1, 1));
    ASSERT_EQ(cells.size(), 1u);
    EXPECT_EQ(cells[0].moments.count, 2);
    EXPECT_EQ(cells[0].moments.weight, 0);
    EXPECT_EQ(cells[0].moments.mean[0], 1);
    EXPECT_EQ(cells[0].moments.deviation[0], 1);
}

/// In long double, whose range none of these squares leaves.
void expect_merged(double mean_a, double weight_a, double deviation_a, double mean_b,
                   double weight_b, double deviation_b) {
    SCOPED_TRACE(testing::Message()
                 << mean_a << " by " << weight_a << ", " << mean_b << " by " << weight_b);
    const Moments merged =
        merge({1, weight_a, {mean_a}, {deviation_a}}, {1, weight_b, {mean_b}, {deviation_b}});
    const long double weight = static_cast<long double>(weight_a) + weight_b;
    const long double share_a = weight_a / weight;
    const long double share_b = weight_b / weight;
    const long double distance = static_cast<long double>(mean_b) - mean_a;
    const long double mean = mean_a + share_b * distance;
    const long double variance = share_a * deviation_a * deviation_a +
                                 share_b * deviation_b * deviation_b +
                                 share_a * share_b * distance * distance;
    const double largest = std::max(std::abs(mean_a), std::abs(mean_b));
    EXPECT_TRUE(std::isfinite(merged.mean[0]));
    EXPECT_TRUE(std::isfinite(merged.deviation[0]));
    EXPECT_GE(merged.mean[0], std::min(mean_a, mean_b));
    EXPECT_LE(merged.mean[0], std::max(mean_a, mean_b));
    const long double smallest = std::numeric_limits<double>::denorm_min();
    EXPECT_LE(std::abs(merged.mean[0] - mean), 4e-16L * largest + smallest);
    const long double deviation = std::sqrt(variance);
    EXPECT_LE(std::abs(merged.deviation[0] - deviation), 1e-15L * deviation + smallest);
}

TEST(Moments, merge_at_the_ends_of_the_range_of_a_double) {
    constexpr double most = std::numeric_limits<double>::max();
    const std::array means = {-most,  -1.7e308, -1e308, -1.0,    -5e-324, 0.0,
                              1e-300, 1.0,      1e308,  1.7e308, most};
    for (const double mean_a : means)
        for (const double mean_b : means)
            for (const double weight : {1e-300, 1e-16, 0.1, 1.0, 3.0, 1e10})
                expect_merged(mean_a, 1, 0, mean_b, weight, 0);
    // All that two ranks hold lies at both ends.
    for (const double weight : {0.1, 1.0, 3.0}) expect_merged(0, 1, most, 0, weight, most);
    // Rounding takes the difference of these up, and the mean beyond the larger one.
    expect_merged(std::ldexp(3, 970), 1e-100, 0, most, 1e100, 0);
}

TEST(Moments, merge_with_nothing_changes_nothing) {
    const Moments some{3, 3, {1, 2, 3}, {4, 5, 6}};
    EXPECT_EQ(merge(some, {}).mean, some.mean);
    EXPECT_EQ(merge({}, some).deviation, some.deviation);
}

}  // namespace
}  // namespace rrcb
