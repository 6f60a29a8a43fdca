#include "hard_clouds.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/quality.hpp>

#include <numeric>

namespace rrcb::hard_test {
namespace {

INSTANTIATE_TEST_SUITE_P(Distributions, HardCloud,
                         testing::ValuesIn(names_of(clouds_hard_by_distribution())), name_of);

TEST(Distributions, without_arrays_on_ranks_without_points) {
    Points nothing;
    nothing.dimension = 2;
    const std::vector<double> x{0, 1, 2, 3};
    const Points points = rank() == 0 ? Points(x, 2) : nothing;
    const Balance result = balance(points, MPI_COMM_WORLD);
    EXPECT_EQ(result.parts.size(), rank() == 0 ? 2u : 0u);
    EXPECT_EQ(result.report.details.num_points, 2);
}

}  // namespace
}  // namespace rrcb::hard_test
