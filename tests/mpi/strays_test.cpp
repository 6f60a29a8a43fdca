// A few points far from all others: they must not set the frame of the estimate.
#include "clouds_of_all_ranks.hpp"

#include <rrcb/balance.hpp>

namespace rrcb {
namespace {

/// A ball, or a cube, of `width` in a box of 1, over which one point in 2,000 is spread.
std::vector<double> in_a_box(int dimension, double width) {
    return test::share_of_cloud(60000, dimension, [&](std::size_t i, int, double u) {
        return i % 2000 == 0 ? u : 0.3 + width * u;
    });
}

TEST(Strays, cost_no_rounds) {
    for (const int dimension : {2, 3})
        for (const double width : {1e-3, 1e-6, 1e-9, 1e-12})
            for (const int num_parts : {4, 64}) {
                SCOPED_TRACE(testing::Message() << dimension << "-D, width " << width << ", "
                                                << num_parts << " parts");
                const std::vector<double> mine = in_a_box(dimension, width);
                Options options{.num_parts = num_parts};
                const Report report =
                    balance(Points(mine, dimension), MPI_COMM_WORLD, options).report;
                EXPECT_LE(report.details.rounds, 6);
                EXPECT_TRUE(report.within_tolerance);
                EXPECT_LE(report.details.estimated_imbalance, 1.01);
            }
}

}  // namespace
}  // namespace rrcb
