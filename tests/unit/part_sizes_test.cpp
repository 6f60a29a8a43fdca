#include "../support/common.hpp"

#include <rrcb/error.hpp>
#include <rrcb/part_sizes.hpp>

#include <numeric>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Iterates until loads of the form n + cost * n^(2/3), each with its own cost, no longer change.
std::vector<double> settled_loads(const std::vector<double>& costs, int corrections) {
    constexpr double points_per_part = 1000;
    std::vector<double> sizes(costs.size(), 1);
    std::vector<double> loads(costs.size());
    for (int k = 0; k <= corrections; ++k) {
        if (k > 0) sizes = balanced_sizes(loads, sizes);
        for (std::size_t p = 0; p < costs.size(); ++p) {
            const double points = points_per_part * sizes[p];
            loads[p] = points + costs[p] * std::pow(points, 2.0 / 3);
        }
    }
    return loads;
}

double spread(const std::vector<double>& loads) {
    return std::log(std::ranges::max(loads) / std::ranges::min(loads));
}

TEST(BalancedSizes, keep_the_sizes_of_even_loads) {
    EXPECT_EQ(balanced_sizes(std::vector<double>{7, 7, 7}), (std::vector<double>{1, 1, 1}));
    const std::vector<double> sizes{1, 3};
    EXPECT_EQ(balanced_sizes(std::vector<double>{5, 5}, sizes), sizes);
    EXPECT_TRUE(balanced_sizes({}).empty());
}

TEST(BalancedSizes, are_in_proportion_to_a_power_of_the_loads) {
    const std::vector<double> sizes = balanced_sizes(std::vector<double>{1, 2, 3});
    EXPECT_DOUBLE_EQ(sizes[0] + sizes[1] + sizes[2], 3);
    EXPECT_NEAR(sizes[1] / sizes[0], std::pow(0.5, 0.7), 1e-15);
    EXPECT_NEAR(sizes[2] / sizes[1], std::pow(2.0 / 3, 0.7), 1e-15);
}

TEST(BalancedSizes, even_out_loads_that_grow_less_than_points) {
    // d log load / d log points is from 2/3 to 1, so a correction leaves from 0.3 to 1 - 0.7 * 2/3.
    const std::vector<double> costs{0, 2, 4, 10};
    const double before = spread(settled_loads(costs, 0));
    EXPECT_NEAR(before, std::log(2), 1e-12);
    for (int corrections = 1; corrections <= 12; ++corrections) {
        const double after = spread(settled_loads(costs, corrections));
        EXPECT_LE(after, before * std::pow(1 - 0.7 * 2 / 3, corrections));
        EXPECT_GE(after, before * std::pow(0.3, corrections));
    }
}

TEST(BalancedSizes, change_by_no_more_than_a_factor_of_two) {
    const std::vector<double> sizes = balanced_sizes(std::vector<double>{1e-300, 1, 1});
    EXPECT_DOUBLE_EQ(sizes[0] + sizes[1] + sizes[2], 3);
    EXPECT_LE(sizes[0] / sizes[1], 4);
}

TEST(BalancedSizes, leave_parts_without_load_or_size) {
    const std::vector<double> sizes{2, 0, 2};
    EXPECT_EQ(balanced_sizes(std::vector<double>{4, 9, 0}, sizes), sizes);
    EXPECT_EQ(balanced_sizes(std::vector<double>{0, 0}), (std::vector<double>{1, 1}));
}

TEST(BalancedSizes, refuse_what_is_no_load_or_size) {
    for (const double wrong : {-1.0, infinity, std::nan("")}) {
        EXPECT_THROW(std::ignore = balanced_sizes(std::vector<double>{1, wrong}), Error);
        EXPECT_THROW(
            std::ignore = balanced_sizes(std::vector<double>{1, 1}, std::vector<double>{1, wrong}),
            Error);
    }
    EXPECT_THROW(std::ignore = balanced_sizes(std::vector<double>{1, 1}, std::vector<double>{1}),
                 Error);
}

}  // namespace
}  // namespace rrcb
