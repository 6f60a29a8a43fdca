#include "../support/clouds.hpp"
#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

std::vector<double> my_cloud(std::size_t count, int dimension) {
    return test::uniform_cloud(count, dimension, 100 + static_cast<unsigned>(rank()));
}

double measured_imbalance(const Points& points, const Balance& result,
                          std::span<const double> sizes = {}) {
    return imbalance(part_weights(points, result, MPI_COMM_WORLD), sizes);
}

TEST(Balance, default_method_balances_a_uniform_cloud_in_every_dimension) {
    for (const int dimension : {1, 2, 3}) {
        const std::vector<double> cloud = my_cloud(20000, dimension);
        const Points points = interleaved_points(cloud, dimension);
        Options options;
        options.num_parts = 6;
        const Balance result = balance(points, options, {}, MPI_COMM_WORLD);
        EXPECT_LT(measured_imbalance(points, result), 1.02);
        EXPECT_NEAR(result.report.details.estimated_imbalance, 1, 1e-9);
        EXPECT_EQ(result.report.details.num_points, 20000 * num_ranks());
        EXPECT_EQ(result.report.details.total_weight, 20000.0 * num_ranks());
    }
}

TEST(Balance, weights_and_part_sizes_are_honoured) {
    const std::vector<double> cloud = my_cloud(20000, 2);
    std::vector<double> weights;
    for (std::size_t i = 0; i < cloud.size(); i += 2) weights.push_back(1 + 9 * cloud[i]);
    const Points points = interleaved_points(cloud, 2, weights);
    Options options;
    options.num_parts = 3;
    options.part_sizes = {1, 0, 3};
    const Balance result = balance(points, options, {}, MPI_COMM_WORLD);
    EXPECT_LT(measured_imbalance(points, result, options.part_sizes), 1.02);
}

TEST(Balance, one_rank_holding_everything_is_relieved) {
    const std::vector<double> cloud =
        rank() == num_ranks() - 1 ? my_cloud(30000, 2) : std::vector<double>();
    const Points points = interleaved_points(cloud, 2);
    const Balance result = balance(points, {}, {}, MPI_COMM_WORLD);
    EXPECT_EQ(result.parts.size(), points.count);
    EXPECT_LT(measured_imbalance(points, result), 1.03);
}

TEST(Balance, no_points_anywhere_is_no_error) {
    const Balance result = balance(interleaved_points({}, 3), {}, {}, MPI_COMM_WORLD);
    EXPECT_EQ(result.report.details.num_points, 0);
    EXPECT_EQ(result.report.details.surplus_parts, num_ranks());
    EXPECT_EQ(result.report.details.estimated_imbalance, 1);
}

TEST(Balance, one_point_per_rank_goes_to_parts_of_its_own) {
    const std::vector<double> mine{static_cast<double>(rank()), 0.5};
    const Points points = interleaved_points(mine, 2);
    const Balance result = balance(points, {}, {}, MPI_COMM_WORLD);
    EXPECT_EQ(result.parts, std::vector<Part>{rank()});
}

TEST(Balance, fewer_points_than_parts_are_reported) {
    const std::vector<double> mine =
        rank() == 0 ? std::vector<double>{1, 2, 3} : std::vector<double>();
    Options options;
    options.num_parts = 5;
    const Balance result = balance(interleaved_points(mine, 1), options, {}, MPI_COMM_WORLD);
    EXPECT_EQ(result.report.details.surplus_parts, 2);
}

TEST(Balance, weights_that_are_all_zero_mean_balance_by_count) {
    const std::vector<double> cloud = my_cloud(10000, 2);
    const std::vector<double> weights(10000, 0.0);
    Options options;
    options.num_parts = 4;
    const Balance result =
        balance(interleaved_points(cloud, 2, weights), options, {}, MPI_COMM_WORLD);
    EXPECT_TRUE(result.report.details.all_weights_zero);
    EXPECT_LT(measured_imbalance(interleaved_points(cloud, 2), result), 1.05);
}

TEST(Balance, points_at_one_place_end_up_in_one_part) {
    const std::vector<double> same(200, 0.25);
    Options options;
    options.num_parts = 4;
    const Balance result = balance(interleaved_points(same, 2), options, {}, MPI_COMM_WORLD);
    for (const Part part : result.parts) EXPECT_EQ(part, result.parts[0]);
}

TEST(Balance, same_input_gives_the_same_bits_on_all_ranks) {
    const std::vector<double> cloud = my_cloud(5000, 3);
    Options options;
    options.num_parts = 13;
    const Points points = interleaved_points(cloud, 3);
    const Balance first = balance(points, options, {}, MPI_COMM_WORLD);
    const Balance second = balance(points, options, {}, MPI_COMM_WORLD);
    EXPECT_EQ(first.parts, second.parts);
    std::vector<Cut> at_root = first.cuts.tree;
    MPI_Bcast(at_root.data(), static_cast<int>(at_root.size() * sizeof(Cut)), MPI_BYTE, 0,
              MPI_COMM_WORLD);
    ASSERT_EQ(second.cuts.tree.size(), at_root.size());
    for (std::size_t k = 0; k < at_root.size(); ++k) {
        EXPECT_EQ(second.cuts.tree[k].axis, at_root[k].axis);
        EXPECT_EQ(std::memcmp(&second.cuts.tree[k].at, &at_root[k].at, sizeof(Vector)), 0);
    }
}

/// Members of structs, and interleaved arrays of which each gives one axis.
TEST(Balance, takes_points_at_any_stride_and_from_several_arrays) {
    for (const std::size_t stride : {2u, 3u, 8u}) {
        const std::vector<double> cloud = my_cloud(500, 2);
        std::vector<double> x(500 * stride, -1e9);
        std::vector<double> y(500 * stride, 1e9);
        for (std::size_t i = 0; i < 500; ++i) {
            x[i * stride] = cloud[2 * i];
            y[i * stride] = cloud[2 * i + 1];
        }
        const Points expected = interleaved_points(cloud, 2);
        const Points points{.dimension = 2, .count = 500, .stride = stride, .axes = {x, y}};
        const Balance result = balance(points, {}, {}, MPI_COMM_WORLD);
        EXPECT_EQ(result.parts, balance(expected, {}, {}, MPI_COMM_WORLD).parts);
    }
}

TEST(Balance, works_on_a_part_of_the_ranks) {
    MPI_Comm half = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank() % 2, rank(), &half);
    const std::vector<double> cloud = my_cloud(1000, 2);
    const Balance result = balance(interleaved_points(cloud, 2), {}, {}, half);
    int size = 0;
    MPI_Comm_size(half, &size);
    EXPECT_EQ(result.cuts.num_parts, size);
    MPI_Comm_free(&half);
}

}  // namespace
}  // namespace rrcb
