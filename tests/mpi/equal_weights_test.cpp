// Weights that are all the same, or all 0, give the parts of points without weights, to the bit.
#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.hpp>

#include <bit>

namespace rrcb {
namespace {

/// Divides points of one weight, of none if it is negative; then again after they have moved, by
/// the cuts and from scratch on their new ranks.
std::vector<Balance> results_with(double weight, const Options& options) {
    const std::vector<double> all = test::uniform_cloud(1001, 2, 5);
    std::vector<double> mine;
    for (std::size_t i = static_cast<std::size_t>(rank()); i < 1001;
         i += static_cast<std::size_t>(num_ranks()))
        mine.insert(mine.end(), {all[2 * i], all[2 * i + 1]});
    std::vector<double> weights(weight < 0 ? 0 : mine.size() / 2, weight);
    std::vector<Balance> made;
    made.push_back(balance(Points(mine, 2, weights), MPI_COMM_WORLD, options));
    mine = transfer(plan(made[0], MPI_COMM_WORLD), column(mine, 2), MPI_COMM_WORLD);
    weights.assign(weight < 0 ? 0 : mine.size() / 2, weight);
    made.push_back(balance(Points(mine, 2, weights), MPI_COMM_WORLD, options));
    for (std::size_t i = 0; i < mine.size(); i += 2) mine[i] += 0.2 * mine[i + 1];
    const Points moved(mine, 2, weights);
    made.push_back(balance(moved, MPI_COMM_WORLD, options, made[0].cuts));
    return made;
}

bool are_bit_identical(const Balance& a, const Balance& b) {
    return a.parts == b.parts &&
           std::bit_cast<std::uint64_t>(a.report.imbalance) ==
               std::bit_cast<std::uint64_t>(b.report.imbalance) &&
           a.report.kept == b.report.kept && a.report.details.rounds == b.report.details.rounds &&
           std::ranges::equal(a.cuts.tree, b.cuts.tree, [](const Cut& x, const Cut& y) {
               return x.axis == y.axis && x.divides == y.divides && x.at == y.at;
           });
}

TEST(EqualWeights, change_no_bit) {
    for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact})
        for (int num_parts = 2; num_parts <= 17; ++num_parts) {
            Options options{.num_parts = num_parts, .refine = refine};
            if (num_parts % 4 == 3) options.expert.max_root_parts = 2;
            const std::vector<Balance> none = results_with(-1, options);
            for (const double weight : {0.0, 1.0, 3.0, 0.1, 1e-300, 0x1p-20, 0x1p40}) {
                const std::vector<Balance> equal = results_with(weight, options);
                for (std::size_t k = 0; k < none.size(); ++k)
                    EXPECT_TRUE(are_bit_identical(equal[k], none[k]))
                        << num_parts << " parts, weight " << weight << ", call " << k;
                const auto& counts = none[0].report.part_weights;
                for (std::size_t part = 0; part < counts.size(); ++part)
                    EXPECT_EQ(equal[0].report.part_weights.at(part),
                              counts[part] * (weight > 0 ? weight : 1));
            }
        }
}

TEST(EqualWeights, of_some_ranks_are_no_counts) {
    if (num_ranks() < 2) GTEST_SKIP() << "needs ranks of other weights";
    // Rank 0 has half of the weight in a tenth of the points.
    const std::size_t count = rank() == 0 ? 100 : 900 / static_cast<std::size_t>(num_ranks() - 1);
    const std::vector<double> mine = test::uniform_cloud(count, 1, static_cast<unsigned>(rank()));
    const std::vector<double> weights(count, rank() == 0 ? 9 : 1);
    for (const double scale : {1.0, 0.0}) {
        std::vector<double> scaled = weights;
        if (rank() > 0) std::ranges::fill(scaled, scale);
        Options options{.num_parts = 3, .refine = Refine::none};
        const Points points(mine, 1, scaled);
        const Balance made = balance(points, MPI_COMM_WORLD, options);
        const auto of_parts = part_weights(points, made.parts, 3, MPI_COMM_WORLD);
        EXPECT_LT(imbalance(of_parts, {}), 1.25) << scale;
    }
}

}  // namespace
}  // namespace rrcb
