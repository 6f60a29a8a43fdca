#include "../support/common.hpp"

#include <rrcb/error.hpp>
#include <rrcb/paper.hpp>
#include <rrcb/quality.hpp>

namespace rrcb {
namespace {

TEST(Quality, imbalance_is_heaviest_over_mean) {
    EXPECT_DOUBLE_EQ(imbalance(std::vector<double>{1, 2, 3}), 1.5);
    EXPECT_DOUBLE_EQ(imbalance(std::vector<double>{5, 5}), 1);
}

TEST(Quality, imbalance_of_subnormal_weights_keeps_its_digits) {
    const double unit = 5e-324;
    EXPECT_DOUBLE_EQ(imbalance(std::vector<double>{2 * unit, unit, unit, unit}), 8.0 / 5);
}

TEST(Quality, imbalance_is_relative_to_the_sizes_asked_for) {
    const std::vector<double> sizes{1, 3};
    EXPECT_DOUBLE_EQ(imbalance(std::vector<double>{25, 75}, sizes), 1);
    EXPECT_DOUBLE_EQ(imbalance(std::vector<double>{50, 50}, sizes), 2);
}

TEST(Quality, weight_in_a_part_of_size_zero_is_an_infinite_imbalance) {
    const std::vector<double> sizes{0, 1};
    EXPECT_DOUBLE_EQ(imbalance(std::vector<double>{0, 7}, sizes), 1);
    EXPECT_TRUE(std::isinf(imbalance(std::vector<double>{1, 6}, sizes)));
}

TEST(Quality, nothing_at_all_is_balanced) {
    EXPECT_EQ(imbalance(std::vector<double>{0, 0, 0}), 1);
    EXPECT_EQ(load_unbalance_percent(std::vector<double>{0, 0}), std::vector<double>(2));
}

TEST(Quality, load_unbalance_is_negative_where_a_part_holds_too_much) {
    const std::vector<double> lu = load_unbalance_percent(std::vector<double>{8, 10, 15, 7});
    EXPECT_DOUBLE_EQ(lu[0], 20);
    EXPECT_DOUBLE_EQ(lu[1], 0);
    EXPECT_DOUBLE_EQ(lu[2], -50);
    EXPECT_DOUBLE_EQ(lu[3], 30);
}

TEST(Quality, sizes_of_other_parts_are_refused) {
    const std::vector<double> weights{1, 2, 3};
    const std::vector<double> sizes{1, 2};
    EXPECT_THROW(imbalance(weights, sizes), Error);
    EXPECT_THROW(imbalance(sizes, weights), Error);
    EXPECT_THROW(load_unbalance_percent(weights, sizes), Error);
}

TEST(Quality, no_imbalance_follows_from_weights_that_are_no_numbers) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {infinity, std::nan("")})
        EXPECT_TRUE(std::isnan(imbalance(std::vector<double>{1, bad, 1})));
}

}  // namespace
}  // namespace rrcb
