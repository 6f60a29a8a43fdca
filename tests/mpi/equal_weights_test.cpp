// Weights that are all the same, or all 0, give the parts of points without weights.
#include "../support/clouds.hpp"
#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

struct Result {
    std::vector<Part> parts;
    std::vector<Cut> tree;
    double imbalance;
};

/// Divides points of one weight; of none if it is negative.
Result result_with(double weight, const Options& options) {
    const std::vector<double> all = test::uniform_cloud(1001, 2, 5);
    std::vector<double> mine;
    for (std::size_t i = static_cast<std::size_t>(rank()); i < 1001;
         i += static_cast<std::size_t>(num_ranks()))
        mine.insert(mine.end(), {all[2 * i], all[2 * i + 1]});
    std::vector<double> weights(weight < 0 ? 0 : mine.size() / 2, weight);
    const Balance made = balance(interleaved_points(mine, 2, weights), options, MPI_COMM_WORLD);
    return {made.parts, made.cuts.tree, made.report.imbalance};
}

bool are_bit_identical(const Result& a, const Result& b) {
    return a.parts == b.parts && std::ranges::equal(a.tree, b.tree, [](const Cut& x, const Cut& y) {
               return x.axis == y.axis && x.divides == y.divides && x.at == y.at;
           });
}

TEST(EqualWeights, of_a_power_of_two_and_zero_change_no_bit) {
    for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact})
        for (int num_parts = 2; num_parts <= 17; ++num_parts) {
            Options options;
            options.num_parts = num_parts;
            options.refine = refine;
            const Result none = result_with(-1, options);
            for (const double weight : {0.0, 1.0, 2.0, 0x1p-20, 0x1p40})
                EXPECT_TRUE(are_bit_identical(result_with(weight, options), none))
                    << num_parts << " parts, weight " << weight;
        }
}

TEST(EqualWeights, of_any_size_change_parts_by_rounding_only) {
    for (int num_parts = 2; num_parts <= 17; ++num_parts) {
        Options options;
        options.num_parts = num_parts;
        const Result none = result_with(-1, options);
        for (const double weight : {3.0, 0.1}) {
            const Result equal = result_with(weight, options);
            int num_moved = 0;
            for (std::size_t i = 0; i < none.parts.size(); ++i)
                num_moved += equal.parts[i] != none.parts[i] ? 1 : 0;
            MPI_Allreduce(MPI_IN_PLACE, &num_moved, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
            // A cut between the same two points, or one point further.
            EXPECT_LE(num_moved, 2 * num_parts) << num_parts << " parts, weight " << weight;
            EXPECT_NEAR(equal.imbalance, none.imbalance, num_parts / 1001.0 + 1e-12);
        }
    }
}

}  // namespace
}  // namespace rrcb
