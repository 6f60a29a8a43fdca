// Points at rest stay where many ranks make the parts.
#include "held_points.hpp"

#include <rrcb/cuts.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rrcb {
namespace {

using test::HeldPoints;
using test::imbalance_of;
using test::move_to;
using test::num_ranks;
using test::Share;

Options spread_options(double tolerance) {
    Options options;
    options.expert.max_root_parts = 2;
    options.refine = Refine::tolerance;
    options.imbalance_tolerance = tolerance;
    return options;
}

/// The cuts tell the part of every point, of any rank, but of those that they divide. Collective.
void expect_cuts_of_all(const HeldPoints& all, const Balance& result) {
    const Points points(all.coordinates, all.dimension);
    const std::vector<Part> parts = assign(result.cuts, points, MPI_COMM_WORLD);
    std::size_t num_strays = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) num_strays += parts[i] != all.owners[i] ? 1 : 0;
    if (result.report.details.coincident_cuts == 0) {
        EXPECT_EQ(num_strays, 0u);
    }
}

/// Of sums of weights that are added in another order.
constexpr double rounding = 1e-12;

bool are_equal(const Cuts& one, const Cuts& other) {
    return std::ranges::equal(one.tree, other.tree, [](const Cut& a, const Cut& b) {
        return a.axis == b.axis && a.at == b.at && a.divides == b.divides;
    });
}

/// The cuts are the same whichever ranks hold the points, so these move in the first call only.
void expect_rest(HeldPoints all, const Options& options) {
    Cuts before;
    for (int call = 1; call <= 3; ++call) {
        const Share mine(all);
        const Balance result = balance(mine.points(), MPI_COMM_WORLD, options);
        const std::size_t num_moved = move_to(result.parts, all);
        const Cuts& cuts = result.cuts;
        if (call > 1) {
            EXPECT_EQ(num_moved, 0u) << "call " << call;
            EXPECT_TRUE(are_equal(cuts, before)) << "call " << call;
        }
        EXPECT_NEAR(result.report.imbalance, imbalance_of(all, options), rounding);
        EXPECT_EQ(result.report.within_tolerance,
                  result.report.imbalance <= options.imbalance_tolerance);
        expect_cuts_of_all(all, result);
        before = cuts;
    }
}

HeldPoints random_points(std::size_t count, int dimension, unsigned seed) {
    HeldPoints all{dimension, test::uniform_cloud(count, dimension, seed)};
    all.scatter();
    return all;
}

TEST(SpreadPointsAtRest, of_any_dimension_and_weight_rest) {
    for (const int dimension : {1, 2, 3}) {
        HeldPoints all = random_points(6000, dimension, 3);
        expect_rest(all, spread_options(1.05));
        all.weights = test::uniform_cloud(all.count(), 1, 8);
        expect_rest(all, spread_options(1.05));
        for (double& weight : all.weights) weight = weight < 0.1 ? 5e-324 : 0;
        expect_rest(all, spread_options(1.05));
        std::ranges::fill(all.weights, 0.0);
        expect_rest(all, spread_options(1.05));
    }
}

// Positions over 300 decades.
TEST(SpreadPointsAtRest, with_heavy_tails_rest) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        HeldPoints all{2, test::uniform_cloud(1000, 2, seed)};
        for (double& x : all.coordinates)
            x = std::copysign(std::pow(10, -300 * std::abs(2 * x - 1)), x - 0.5);
        all.weights = test::uniform_cloud(1000, 1, seed + 1000);
        for (double& weight : all.weights) weight = std::max(0.0, weight - 0.5);
        all.scatter();
        expect_rest(all, spread_options(1.3));
    }
}

TEST(SpreadPointsAtRest, on_lattices_rest) {
    for (const Refine refine : {Refine::tolerance, Refine::exact}) {
        HeldPoints all = random_points(6000, 3, 11);
        for (double& x : all.coordinates) x = std::floor(40 * x);
        Options options = spread_options(1.05);
        options.refine = refine;
        expect_rest(all, options);
    }
}

TEST(SpreadPointsAtRest, in_parts_of_given_sizes_rest) {
    Options options = spread_options(1.05);
    for (int part = 0; part < num_ranks(); ++part) options.part_sizes.push_back(1 + part % 3);
    expect_rest(random_points(6000, 2, 4), options);
    options.part_sizes.back() = 0;
    expect_rest(random_points(6000, 2, 4), options);
}

TEST(SpreadPointsAtRest, in_given_axes_or_between_planes_rest) {
    Options options = spread_options(1.05);
    options.expert.axes.plain = true;
    expect_rest(random_points(6000, 2, 5), options);
    options.expert.axes.order =
        AxisOrder::given(std::vector<int>(static_cast<std::size_t>(num_ranks()) - 1, 1));
    expect_rest(random_points(6000, 2, 5), options);
}

TEST(SpreadPointsAtRest, in_one_place_and_divided_rest) {
    HeldPoints all{2, std::vector<double>(1200, 0.5)};
    all.scatter();
    Options options = spread_options(1.05);
    options.expert.coincident = Coincident::divide;
    expect_rest(all, options);
}

}  // namespace
}  // namespace rrcb
