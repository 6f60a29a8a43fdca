#include "hard_clouds.hpp"
#include "interface_mpi.hpp"

#include <rrcb/balance.hpp>

namespace rrcb::hard_test {
namespace {

INSTANTIATE_TEST_SUITE_P(Weights, HardCloud, testing::ValuesIn(names_of(clouds_hard_by_weight())),
                         name_of);

Report report_of(const Cloud& cloud, const Options& options) {
    return balance(scattered_share(cloud).points(), MPI_COMM_WORLD, options).report;
}

/// No Zoltan weight, a float, is of this size.
TEST(Weights, near_the_ends_of_the_range_of_a_double) {
    Cloud cloud = find_cloud("weights_across_the_positions");
    cloud.position = [](int i) { return Vector{1e6 * uniform(i, 0)}; };
    cloud.weight = [](int i) { return 1e305 * uniform(i, 1); };
    check_interface(cloud);
    cloud.weight = [](int i) { return 5e-324 * (i % 4); };
    check_interface(cloud);
}

TEST(Weights, heavier_than_a_part_make_the_least_imbalance_known) {
    // 599 points of 1 and one of 1e6, in 4 parts.
    Options options{.num_parts = 4};
    const Report equal = report_of(find_cloud("one_giant_weight"), options);
    EXPECT_DOUBLE_EQ(equal.details.least_imbalance, 1e6 / ((1e6 + 599) / 4));
    EXPECT_GE(equal.imbalance, equal.details.least_imbalance);

    // The largest part should have half of the weight: 1e6 against half of 1000599.
    options.part_sizes = {1, 3, 2, 0};
    EXPECT_DOUBLE_EQ(report_of(find_cloud("one_giant_weight"), options).details.least_imbalance,
                     1e6 / (1000599.0 / 2));
    EXPECT_EQ(report_of(find_cloud("half_the_weights_zero"), options).details.least_imbalance, 1);
}

TEST(Weights, of_zero_lie_in_every_part) {
    const Share share = scattered_share(find_cloud("half_the_weights_zero"));
    Options options{.num_parts = 4};
    for (const Method& method : methods) {
        const Balance result = balance(share.points(), method, options, MPI_COMM_WORLD);
        std::array<int, 4> counts{};
        for (std::size_t i = 0; i < share.weights.size(); ++i)
            counts[static_cast<std::size_t>(result.parts[i])] += share.weights[i] == 0 ? 1 : 0;
        MPI_Allreduce(MPI_IN_PLACE, counts.data(), 4, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
        // 300 of them, evenly spread as the others are: 75 each, give or take.
        for (const int count : counts) EXPECT_NEAR(count, 75, 30) << method.domain_name;
    }
}

}  // namespace
}  // namespace rrcb::hard_test
