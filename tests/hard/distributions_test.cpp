#include "hard_clouds.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/quality.hpp>

#include <numeric>

namespace rrcb::hard_test {
namespace {

using test::rank;

INSTANTIATE_TEST_SUITE_P(Distributions, HardCloud,
                         testing::ValuesIn(names_of(clouds_hard_by_distribution())), name_of);

TEST(Distributions, of_any_number_and_size_of_parts) {
    const Share share = scattered_share(find_cloud("hollow_shell"));
    for (const std::vector<double>& sizes :
         {std::vector<double>{1}, {0, 1}, {1, 0, 0, 2, 1e-3}, {5, 1, 1, 1, 0, 1, 1, 2, 2, 1, 1}}) {
        Options options;
        options.num_parts = static_cast<int>(sizes.size());
        options.part_sizes = sizes;
        options.refine = Refine::exact;
        const Balance result = balance(share.points(), options, {}, MPI_COMM_WORLD);
        const auto counts =
            part_weights(share.points(), result.parts, options.num_parts, MPI_COMM_WORLD);
        const double all = std::accumulate(sizes.begin(), sizes.end(), 0.0);
        for (std::size_t part = 0; part < sizes.size(); ++part) {
            EXPECT_NEAR(counts[part], 600 * sizes[part] / all, 2) << part;
            if (sizes[part] == 0) {
                EXPECT_EQ(counts[part], 0);
            }
        }
    }
}

TEST(Distributions, without_arrays_on_ranks_without_points) {
    Points nothing;
    nothing.dimension = 2;
    const std::vector<double> x{0, 1, 2, 3};
    const Points points = rank() == 0 ? interleaved_points(x, 2) : nothing;
    const Balance result = balance(points, Options{}, {}, MPI_COMM_WORLD);
    EXPECT_EQ(result.parts.size(), rank() == 0 ? 2u : 0u);
    EXPECT_EQ(result.report.details.num_points, 2);
}

}  // namespace
}  // namespace rrcb::hard_test
