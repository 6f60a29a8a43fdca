// Points that each rank holds by the last call, where many ranks make the parts: they come to rest.
#include "balance_mpi.hpp"
#include "collective/duplicate.hpp"
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
using test::rank;
using test::Share;

Options spread_options(double tolerance) {
    Options options;
    options.tuning.central_parts = 2;
    options.cuts = HeldCuts::own;
    options.refine = Refine::tolerance;
    options.imbalance_tolerance = tolerance;
    return options;
}

/// The cuts tell the part of every point, of any rank, but of those that they divide. Collective.
void expect_cuts_of_all(const HeldPoints& all, const Balance& result) {
    ASSERT_FALSE(is_whole(result.cuts));
    const Points points = interleaved_points(all.coordinates, all.dimension);
    const std::vector<Part> parts = assign_all(result.cuts, points, MPI_COMM_WORLD);
    std::size_t num_strays = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) num_strays += parts[i] != all.owners[i] ? 1 : 0;
    if (result.report.details.coincident_cuts == 0) {
        EXPECT_EQ(num_strays, 0u);
    }
}

/// Of sums of weights that are added in another order.
constexpr double rounding = 1e-12;

/// Points move in the first `most_moves` calls at most, and never to a worse balance.
void expect_rest(HeldPoints all, const Options& options, int most_moves) {
    double before = 0;
    for (int call = 1; call <= most_moves + 2; ++call) {
        const Share mine(all);
        const Balance result = balance(mine.points(), options, MPI_COMM_WORLD);
        const std::size_t num_moved = move_to(result.parts, all);
        const double now = imbalance_of(all, options);
        if (call > 1) {
            EXPECT_LE(now, before);
        }
        EXPECT_EQ(result.report.kept, num_moved == 0);
        if (num_moved > 0) {
            EXPECT_LE(call, most_moves) << num_moved << " points";
        }
        EXPECT_NEAR(result.report.imbalance, now, rounding);
        EXPECT_EQ(result.report.within_tolerance,
                  result.report.imbalance <= options.imbalance_tolerance);
        expect_cuts_of_all(all, result);
        before = now;
    }
}

HeldPoints random_points(std::size_t count, int dimension, unsigned seed) {
    HeldPoints all{dimension, test::uniform_cloud(count, dimension, seed)};
    all.scatter();
    return all;
}

TEST(SpreadKeptPoints, of_any_dimension_and_weight_rest) {
    for (const int dimension : {1, 2, 3}) {
        HeldPoints all = random_points(6000, dimension, 3);
        expect_rest(all, spread_options(1.05), 2);
        all.weights = test::uniform_cloud(all.count(), 1, 8);
        expect_rest(all, spread_options(1.05), 2);
        for (double& weight : all.weights) weight = weight < 0.1 ? 5e-324 : 0;
        expect_rest(all, spread_options(1.05), 2);
        std::ranges::fill(all.weights, 0.0);
        expect_rest(all, spread_options(1.05), 2);
    }
}

// Positions over 300 decades: extents of cells and of points have other longest axes. A call may
// move points to a worse balance within the tolerance, but not for ever.
TEST(SpreadKeptPoints, with_heavy_tails_rest) {
    for (unsigned seed = 1; seed <= 100; ++seed) {
        HeldPoints all{2, test::uniform_cloud(1000, 2, seed)};
        for (double& x : all.coordinates)
            x = std::copysign(std::pow(10, -300 * std::abs(2 * x - 1)), x - 0.5);
        all.weights = test::uniform_cloud(1000, 1, seed + 1000);
        for (double& weight : all.weights) weight = std::max(0.0, weight - 0.5);
        all.scatter();
        for (int call = 1; call <= 6; ++call) {
            const Balance result =
                balance(Share(all).points(), spread_options(1.3), MPI_COMM_WORLD);
            EXPECT_TRUE(result.report.kept || call <= 4) << seed << " in call " << call;
            move_to(result.parts, all);
        }
    }
}

TEST(SpreadKeptPoints, in_parts_of_given_sizes_rest) {
    Options options = spread_options(1.05);
    for (int part = 0; part < num_ranks(); ++part) options.part_sizes.push_back(1 + part % 3);
    expect_rest(random_points(6000, 2, 4), options, 2);
    options.part_sizes.back() = 0;
    expect_rest(random_points(6000, 2, 4), options, 2);
}

TEST(SpreadKeptPoints, in_given_axes_or_between_planes_rest) {
    Options options = spread_options(1.05);
    options.axes.plain = true;
    expect_rest(random_points(6000, 2, 5), options, 2);
    options.axes.order =
        AxisOrder::given(std::vector<int>(static_cast<std::size_t>(num_ranks()) - 1, 1));
    expect_rest(random_points(6000, 2, 5), options, 2);
}

TEST(SpreadKeptPoints, in_one_place_and_divided_rest) {
    HeldPoints all{2, std::vector<double>(1200, 0.5)};
    all.scatter();
    Options options = spread_options(1.05);
    options.coincident = Coincident::divide;
    expect_rest(all, options, 2);
}

// Both stay at once, and tell the same cuts.
TEST(SpreadKeptPoints, have_the_cuts_that_rank_0_finds_alone) {
    for (const int dimension : {1, 2, 3}) {
        HeldPoints all = random_points(3000, dimension, 6);
        move_to(balance(Share(all).points(), spread_options(1.02), MPI_COMM_WORLD).parts, all);
        const Share mine(all);
        Options options = spread_options(2);
        const Balance spread = balance(mine.points(), options, MPI_COMM_WORLD);
        options.tuning.central_parts = 64;
        const Balance central = balance(mine.points(), options, MPI_COMM_WORLD);
        ASSERT_TRUE(spread.report.kept);
        ASSERT_TRUE(central.report.kept);
        EXPECT_NEAR(spread.report.imbalance, central.report.imbalance, rounding);
        const Cuts cuts = gather_cuts(spread.cuts, MPI_COMM_WORLD);
        ASSERT_EQ(cuts.tree.size(), central.cuts.tree.size());
        for (std::size_t k = 0; k < cuts.tree.size(); ++k) {
            EXPECT_EQ(cuts.tree[k].axis, central.cuts.tree[k].axis);
            EXPECT_EQ(cuts.tree[k].at, central.cuts.tree[k].at);
        }
    }
}

/// Balanced points of which those in a part are on the rank rank_of(part).
template <class RankOf>
HeldPoints balanced(RankOf&& rank_of) {
    HeldPoints all = random_points(3000, 2, 7);
    move_to(balance(Share(all).points(), spread_options(1.02), MPI_COMM_WORLD).parts, all);
    for (Part& owner : all.owners) owner = rank_of(owner);
    return all;
}

TEST(SpreadKeptPoints, are_not_kept_where_a_rank_holds_another_part) {
    const HeldPoints all = balanced([](Part part) { return (part + 1) % num_ranks(); });
    const Balance result = balance(Share(all).points(), spread_options(2), MPI_COMM_WORLD);
    EXPECT_FALSE(result.report.kept);
}

TEST(SpreadKeptPoints, are_not_kept_in_slabs) {
    HeldPoints all = random_points(3000, 2, 9);
    for (std::size_t i = 0; i < all.count(); ++i)
        all.owners[i] = static_cast<Part>(all.coordinates[2 * i] * num_ranks());
    const Balance result = balance(Share(all).points(), spread_options(2), MPI_COMM_WORLD);
    EXPECT_FALSE(result.report.kept);
}

TEST(SpreadKeptPoints, are_kept_only_if_all_ranks_allow_it) {
    const HeldPoints all = balanced([](Part part) { return part; });
    const Share mine(all);
    Participant self{mpi::duplicate_of(MPI_COMM_WORLD)};
    for (const bool is_allowed : {true, false}) {
        const bool may_stay = is_allowed || rank() != num_ranks() - 1;
        const Balance result = balance(mine.points(), spread_options(2), nullptr, may_stay, self);
        EXPECT_EQ(result.report.kept, is_allowed);
    }
}

}  // namespace
}  // namespace rrcb
