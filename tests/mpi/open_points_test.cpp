// Balances whose open points stay with their passes: the engine gets numbers, and few positions.
#include "../support/brute_open_points.hpp"
#include "../support/brute_passes.hpp"
#include "../support/clouds.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace rrcb {
namespace {

/// Passes that never copy a point, except into a sample.
class KeepingPasses final : public test::BrutePasses {
  public:
    using BrutePasses::BrutePasses;

    std::unique_ptr<OpenPoints> open(const Cuts& cuts, std::span<const Bracket> intervals,
                                     bool /*has_parts*/) override {
        ++num_opened;
        return std::make_unique<test::BruteOpenPoints>(all_, cuts, intervals, parts_, num_taken);
    }
    void collect(const Cuts&, std::span<const Bracket>, bool, Collected&) override { refuse(); }
    std::vector<std::size_t> collect_more(std::span<const Wanted>, Collected&) override {
        refuse();
    }
    std::vector<Box> boxes(int) override { refuse(); }
    void settle(const Collected&, std::span<const Part>) override { refuse(); }

    int num_opened = 0;
    std::size_t num_taken = 0;  ///< positions

  private:
    [[noreturn]] static void refuse() {
        throw Error(ErrorCode::invalid_argument, "the points stay where they are");
    }
};

std::vector<Options> kinds() {
    std::vector<Options> kinds(6);
    for (Options& one : kinds) one.num_parts = 11;
    kinds[1].refine = Refine::exact;
    kinds[2].imbalance_tolerance = 1.0005;
    kinds[3].refine = Refine::exact;
    kinds[3].expert.coincident = Coincident::divide;
    kinds[4].expert.axes.min_width.assign(2, 0.02);
    kinds[5].expert.axes.plain = true;
    kinds[5].refine = Refine::exact;
    // On more than two ranks many of these make the parts.
    for (int k = 0; k < 4; ++k) kinds.push_back(kinds[static_cast<std::size_t>(k)]);
    for (std::size_t k = 6; k < kinds.size(); ++k) kinds[k].expert.max_root_parts = 2;
    return kinds;
}

TEST(OpenPoints, that_stay_with_their_passes_get_the_same_parts) {
    int num_opened = 0;
    for (const bool is_lattice : {false, true})
        for (const bool is_weighted : {false, true}) {
            std::vector<double> x =
                test::uniform_cloud(800, 2, 7 + static_cast<unsigned>(test::rank()));
            std::vector<double> weights;
            for (double& value : x) value = is_lattice ? std::floor(12 * value) : value * value;
            for (std::size_t i = 0; i < 800 && is_weighted; ++i)
                weights.push_back(static_cast<double>(1 + i % 7));
            for (const Options& options : kinds()) {
                const Balance expected = balance(Points(x, 2, weights), MPI_COMM_WORLD, options);
                KeepingPasses passes(x, 2, weights);
                const Balance made = balance(passes, MPI_COMM_WORLD, options);
                EXPECT_EQ(passes.parts(), expected.parts);
                EXPECT_EQ(made.report.details.rounds, expected.report.details.rounds);
                for (std::size_t k = 0; k < made.cuts.tree.size(); ++k)
                    EXPECT_EQ(made.cuts.tree[k].at, expected.cuts.tree[k].at) << "cut " << k;
                num_opened += passes.num_opened;
            }
        }
    EXPECT_GT(num_opened, 0);
}

TEST(OpenPoints, send_few_positions_to_the_engine) {
    const std::size_t num_points = 40000;
    const std::vector<double> x =
        test::uniform_cloud(num_points, 2, 7 + static_cast<unsigned>(test::rank()));
    Options options;
    options.num_parts = 2;
    options.refine = Refine::exact;
    KeepingPasses passes(x, 2);
    balance(passes, MPI_COMM_WORLD, options);
    EXPECT_GT(passes.num_opened, 0);
    EXPECT_LE(passes.num_taken, 1024U) << "of one cut";
}

}  // namespace
}  // namespace rrcb
