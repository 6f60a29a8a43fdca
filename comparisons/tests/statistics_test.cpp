#include "statistics.hpp"

#include "counter_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace comparisons {
namespace {

/// Returns n, n - 1, ..., 1, of which the k-th smallest is k.
std::vector<double> descending(std::size_t n) {
    std::vector<double> values(n);
    std::iota(values.rbegin(), values.rend(), 1.0);
    return values;
}

TEST(Statistics, takes_the_middle) {
    EXPECT_EQ(median({5, 1, 3}), 3);
    EXPECT_EQ(median({8, 1, 2, 4}), 3);
    EXPECT_EQ(median({}), 0);
}

TEST(Statistics, fewer_than_six_values_have_no_interval) {
    // The range of 5 values misses the median with a probability of 2 / 2^5 = 6.25 %.
    for (std::size_t n = 0; n < 6; ++n) EXPECT_FALSE(interval95(descending(n))) << n;
}

TEST(Statistics, leaves_out_as_many_values_as_the_binomial_sums_allow) {
    // The probability to miss the median when j values are left out at each end is 2 (C(n,0) + ...
    // + C(n,j)) / 2^n. Each comment gives it for j and j + 1.
    const struct {
        std::size_t n;
        double low;
    } cases[] = {
        {6, 1},   // 2 * 1 / 64 = 3.1 %; 2 * 7 / 64 = 21.9 %
        {7, 1},   // 2 * 1 / 128 = 1.6 %; 2 * 8 / 128 = 12.5 %
        {8, 1},   // 2 * 1 / 256 = 0.8 %; 2 * 9 / 256 = 7.0 %
        {9, 2},   // 2 * 10 / 512 = 3.9 %; 2 * 46 / 512 = 18.0 %
        {10, 2},  // 2 * 11 / 1024 = 2.1 %; 2 * 56 / 1024 = 10.9 %
        {12, 3},  // 2 * 79 / 4096 = 3.9 %; 2 * 299 / 4096 = 14.6 %
        {20, 6},  // 2 * 21700 / 1048576 = 4.1 %; 2 * 60460 / 1048576 = 11.5 %
        {1000, 469},
    };
    for (const auto& [n, low] : cases) {
        const std::optional<Interval> interval = interval95(descending(n));
        ASSERT_TRUE(interval) << n;
        EXPECT_EQ(interval->low, low) << n;
        EXPECT_EQ(interval->high, static_cast<double>(n) + 1 - low) << n;
    }
}

TEST(Statistics, the_median_lies_in_its_interval) {
    const std::vector<double> values = {3, 1, 4, 1, 5, 9, 2, 6};
    EXPECT_EQ(median(values), 3.5);
    const std::optional<Interval> interval = interval95(values);
    ASSERT_TRUE(interval);
    EXPECT_EQ(interval->low, 1);
    EXPECT_EQ(interval->high, 9);
}

TEST(Statistics, divides_what_was_measured_in_the_same_turn) {
    const std::vector<double> times = {2, 9};
    const std::vector<double> reference = {4, 3};
    EXPECT_EQ(paired_ratios(times, reference), (std::vector<double>{0.5, 3}));
    EXPECT_TRUE(paired_ratios(times, std::vector<double>{4}).empty());
    EXPECT_TRUE(paired_ratios(times, std::vector<double>{4, 0}).empty());
}

TEST(DrawnOrder, has_each_number_once_in_another_order_each_turn) {
    const std::vector<std::size_t> first = drawn_order(20, 1, 0);
    EXPECT_EQ(first, drawn_order(20, 1, 0));
    EXPECT_NE(first, drawn_order(20, 1, 1));
    EXPECT_NE(first, drawn_order(20, 2, 0));
    std::vector<std::size_t> ascending = first;
    std::ranges::sort(ascending);
    for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(ascending[i], i);
    EXPECT_TRUE(drawn_order(0, 1, 0).empty());
}

TEST(DrawnOrder, is_the_last_one_backwards_in_every_second_turn) {
    for (const std::uint64_t turn : {0, 2, 4}) {
        std::vector<std::size_t> backwards = drawn_order(14, 1, turn);
        std::ranges::reverse(backwards);
        EXPECT_EQ(drawn_order(14, 1, turn + 1), backwards);
    }
}

TEST(DrawnOrder, differs_between_workloads) {
    // Each cloud has its own order. With the same order for all of them, one method came second in
    // five of seven turns everywhere.
    EXPECT_NE(seed_for("uniform 2 16", 1), seed_for("uniform 3 16", 1));
    EXPECT_NE(drawn_order(14, seed_for("slope", 1), 0), drawn_order(14, seed_for("shell", 1), 0));
}

}  // namespace
}  // namespace comparisons
