// Balances of points that only passes read, against those of the same points in arrays.
#include "../support/brute_passes.hpp"
#include "../support/clouds.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Cloud {
    Cloud(std::size_t count, int of_dimension, unsigned seed, bool is_lattice = false)
        : dimension(of_dimension),
          coordinates(
              test::uniform_cloud(count, of_dimension, 31 * seed + static_cast<unsigned>(rank()))) {
        if (is_lattice)
            for (double& x : coordinates) x = std::floor(12 * x);
    }

    Points points() const { return interleaved_points(coordinates, dimension, weights); }
    test::BrutePasses passes() const { return {coordinates, dimension, weights}; }

    int dimension;
    std::vector<double> coordinates;
    std::vector<double> weights{};
};

/// Both ways give the same, but for the rounding of sums of weights.
void expect_same(const Cloud& cloud, const Options& options, const Cuts& previous,
                 const std::string& what) {
    const Balance expected = balance(cloud.points(), options, previous, MPI_COMM_WORLD);
    test::BrutePasses passes = cloud.passes();
    const Balance made = balance(passes, options, previous, MPI_COMM_WORLD);
    EXPECT_TRUE(made.parts.empty());
    EXPECT_EQ(passes.parts(), expected.parts) << what;
    EXPECT_EQ(made.report.details.rounds, expected.report.details.rounds) << what;
    EXPECT_EQ(made.report.kept, expected.report.kept) << what;
    EXPECT_EQ(std::isnan(made.report.imbalance), std::isnan(expected.report.imbalance)) << what;
    if (!std::isnan(made.report.imbalance)) {
        EXPECT_NEAR(made.report.imbalance, expected.report.imbalance, 1e-12) << what;
    }
    ASSERT_EQ(made.cuts.tree.size(), expected.cuts.tree.size());
    for (std::size_t k = 0; k < made.cuts.tree.size(); ++k)
        EXPECT_EQ(made.cuts.tree[k].at, expected.cuts.tree[k].at) << what << " cut " << k;
}

std::vector<Options> kinds(int num_parts, int dimension = 2) {
    std::vector<Options> kinds(7);
    for (Options& one : kinds) one.num_parts = num_parts;
    kinds[1].refine = Refine::exact;
    kinds[2].refine = Refine::none;
    kinds[3].imbalance_tolerance = 1.0005;
    kinds[4].refine = Refine::exact;
    kinds[4].coincident = Coincident::divide;
    kinds[5].axes.min_width.assign(static_cast<std::size_t>(dimension), 0.02);
    kinds[6].min_points = 40;
    return kinds;
}

TEST(Passes, give_the_parts_and_the_bits_of_arrays) {
    for (const int dimension : {1, 2, 3})
        for (const bool is_lattice : {false, true})
            for (const int num_parts : {1, 5, 16}) {
                const Cloud cloud(700, dimension, 3, is_lattice);
                int number = 0;
                for (const Options& options : kinds(num_parts, dimension))
                    expect_same(cloud, options, {},
                                std::to_string(dimension) + "-D, kind " + std::to_string(number++) +
                                    ", parts " + std::to_string(num_parts));
            }
}

TEST(Passes, start_from_earlier_cuts_and_weigh) {
    Cloud cloud(900, 2, 5);
    const Balance first = balance(cloud.points(), {}, {}, MPI_COMM_WORLD);
    expect_same(cloud, {}, first.cuts, "kept");
    std::mt19937_64 engine(7);
    for (std::size_t i = 0; i < 900; ++i) cloud.weights.push_back(static_cast<double>(1 + i % 7));
    for (double& x : cloud.coordinates) x = x * x;
    int number = 0;
    for (Options options : kinds(num_ranks())) {
        expect_same(cloud, options, {}, "weighted, kind " + std::to_string(number));
        expect_same(cloud, options, first.cuts, "moved, kind " + std::to_string(number++));
    }
    for (double& weight : cloud.weights) weight = 0.3;
    expect_same(cloud, {}, {}, "equal weights");
}

TEST(Passes, may_have_no_points) {
    Cloud cloud(rank() == 0 ? 500 : 0, 2, 5);
    for (const Options& options : kinds(4)) expect_same(cloud, options, {}, "on one rank");
    const Cloud none(0, 2, 5);
    expect_same(none, {}, {}, "nowhere");
}

std::string error_of(test::BrutePasses& passes, const Options& options) {
    try {
        balance(passes, options, {}, MPI_COMM_WORLD);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Passes, that_fail_on_one_rank_fail_on_all) {
    Cloud cloud(100, 2, 5);
    if (rank() == num_ranks() - 1) cloud.coordinates[7] = nan;
    test::BrutePasses passes = cloud.passes();
    EXPECT_NE(error_of(passes, {}).find("coordinate of point 3"), std::string::npos);
    EXPECT_NE(error_of(passes, {}).find("rank " + std::to_string(num_ranks() - 1)),
              std::string::npos);
}

TEST(Passes, are_refused_if_many_ranks_make_the_parts) {
    const Cloud cloud(100, 2, 5);
    test::BrutePasses passes = cloud.passes();
    Options options;
    options.num_parts = 5;
    options.tuning.central_parts = 2;
    const std::string text = error_of(passes, options);
    EXPECT_EQ(text.find("raise tuning.central_parts") != std::string::npos, num_ranks() > 2)
        << text;
}

}  // namespace
}  // namespace rrcb
