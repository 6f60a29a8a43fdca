// Points that all weigh the same: parts hold whole points.
#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>

namespace rrcb {
namespace {

Options with(int num_parts, Refine refine) {
    Options options{.num_parts = num_parts, .refine = refine};
    return options;
}

TEST(EqualWeights, leave_no_room_within_a_tolerance_of_less_than_a_point) {
    // 16 points to each of 256 parts: 17 would be an imbalance of 1.0625.
    const auto all = test::uniform_cloud(4096, 2, 7);
    const std::span<const double> mine = std::span(all).first(rank() == 0 ? all.size() : 0);
    const Balance result = balance(Points(mine, 2), MPI_COMM_WORLD, with(256, Refine::tolerance));
    EXPECT_EQ(result.report.imbalance, 1);
}

TEST(EqualWeights, of_any_size_are_divided_to_the_point) {
    for (const double weight : {1e-3, 1.0, 1024.0}) {
        SCOPED_TRACE(weight);
        const auto mine = test::uniform_cloud(1024, 2, static_cast<unsigned>(rank()));
        const std::vector<double> weights(1024, weight);
        for (const Refine refine : {Refine::tolerance, Refine::exact}) {
            const Balance result =
                balance(Points(mine, 2, weights), MPI_COMM_WORLD, with(64 * num_ranks(), refine));
            EXPECT_NEAR(result.report.imbalance, 1, 1e-12);
        }
    }
}

TEST(EqualWeights, are_not_taken_for_granted_where_the_root_has_no_points) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const bool is_root = rank() == 0;
    const auto mine = test::uniform_cloud(is_root ? 0 : 1000, 2, 3);
    std::vector<double> weights(is_root ? 0 : 1000);
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] = 1e-6 * (1 + static_cast<double>(i % 7));
    const Balance result =
        balance(Points(mine, 2, weights), MPI_COMM_WORLD, with(8, Refine::exact));
    const double ideal = 4e-3 * (num_ranks() - 1) / 8;
    EXPECT_LE(result.report.imbalance, 1 + 3 * 7e-6 / ideal);
}

}  // namespace
}  // namespace rrcb
