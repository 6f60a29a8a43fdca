// Calls from earlier cuts if many ranks make the parts.
#include "../support/same_error.hpp"
#include "held_points.hpp"
#include "reuse_cases.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/error.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rrcb {
namespace {

using test::HeldPoints;
using test::num_ranks;
using test::rank;
using test::Share;

Options spread_options(int num_parts, double tolerance) {
    Options options = test::with_parts(num_parts, tolerance);
    options.expert.max_root_parts = 2;
    return options;
}

/// Uneven points that all ranks know, with weights where asked for, scattered over the ranks.
HeldPoints uneven_cloud(int dimension, bool has_weights) {
    HeldPoints all{dimension, test::uniform_cloud(3000, dimension, 11)};
    for (double& x : all.coordinates) x *= x;
    std::mt19937_64 engine(12);
    for (std::size_t i = 0; has_weights && i < all.count(); ++i)
        all.weights.push_back(test::uniform(engine, 0.5, 1.5));
    all.scatter();
    return all;
}

void drift(double distance, HeldPoints& all) {
    std::mt19937_64 engine(13);
    for (double& x : all.coordinates) x += test::uniform(engine, -distance, distance);
}

double imbalance_by_look_up(const HeldPoints& all, const Cuts& whole) {
    return imbalance(test::weights_by_look_up(all, whole));
}

/// Each point of this rank is in its part by the earlier cuts and by those returned.
void expect_parts(const Share& mine, const Cuts& whole, const Balance& result) {
    const Points points = mine.points();
    for (LocalIndex i = 0; i < points.count; ++i) {
        ASSERT_EQ(result.parts[i], part_of(whole, points.position(i)));
        ASSERT_EQ(part_of(result.cuts, points.position(i)), result.parts[i]);
    }
}

TEST(SpreadReuse, keeps_cuts_while_their_parts_are_within_the_tolerance) {
    for (const int dimension : {1, 2, 3})
        for (const bool has_weights : {false, true})
            for (const int num_parts : {num_ranks(), 3 * num_ranks() + 1}) {
                HeldPoints all = uneven_cloud(dimension, has_weights);
                const Options options = spread_options(num_parts, 1.2);
                const Balance first = balance(Share(all).points(), MPI_COMM_WORLD, options);
                const Cuts& whole = first.cuts;
                drift(1e-3, all);
                const Share mine(all);
                const Balance again = balance(mine.points(), MPI_COMM_WORLD, options, first.cuts);
                const double expected = imbalance_by_look_up(all, whole);
                ASSERT_LE(expected, 1.2) << "the cloud drifted too far for this test";
                expect_parts(mine, whole, again);
                EXPECT_NEAR(again.report.imbalance, expected, 1e-9);
                EXPECT_TRUE(again.report.within_tolerance);
                EXPECT_EQ(again.report.details.rounds, 1);
                EXPECT_EQ(again.report.details.num_points, 3000);
                EXPECT_EQ(again.report.details.least_imbalance,
                          first.report.details.least_imbalance);
                EXPECT_TRUE(test::same_cuts(again.cuts, whole));
                EXPECT_EQ(std::ssize(again.report.part_weights), num_parts);
                EXPECT_NEAR(imbalance(again.report.part_weights), expected, 1e-9);
            }
}

TEST(SpreadReuse, finds_the_parts_of_points_that_have_come_from_anywhere) {
    const int num_parts = 2 * num_ranks();
    HeldPoints all = uneven_cloud(2, false);
    const Options options = spread_options(num_parts, 3000);
    // Points in the regions of their ranks.
    const Balance first = balance(Share(all).points(), MPI_COMM_WORLD, options);
    const Cuts& whole = first.cuts;
    for (std::size_t i = 0; i < all.count(); ++i) {
        const Part part = part_of(whole, Points(all.coordinates, 2).position(i));
        all.owners[i] = ranks_of_part(part, num_parts, num_ranks()).first_rank;
    }
    const Balance settled = balance(Share(all).points(), MPI_COMM_WORLD, options, first.cuts);
    // Then each rank gets those of others, one after the other.
    for (int turn = 1; turn < num_ranks(); ++turn) {
        for (Part& owner : all.owners) owner = (owner + 1) % num_ranks();
        const Share mine(all);
        const Balance again = balance(mine.points(), MPI_COMM_WORLD, options, settled.cuts);
        expect_parts(mine, whole, again);
        EXPECT_EQ(again.report.details.rounds, 1);
        EXPECT_NEAR(again.report.imbalance, imbalance_by_look_up(all, whole), 1e-9);
    }
}

TEST(SpreadReuse, keeps_points_together_that_a_cut_divided) {
    HeldPoints all{2, std::vector<double>(2 * 600, 0.25)};
    for (std::size_t i = 0; i < 40; ++i) all.coordinates[2 * i] = static_cast<double>(i);
    all.scatter();
    const Share mine(all);
    Options options = spread_options(num_ranks() + 2, 1.02);
    options.expert.coincident = Coincident::divide;
    const Balance first = balance(mine.points(), MPI_COMM_WORLD, options);
    options.imbalance_tolerance = 1000;
    for (const bool plain : {false, true}) {
        options.expert.axes.plain = plain;
        const Balance again = balance(mine.points(), MPI_COMM_WORLD, options, first.cuts);
        const Cuts& after = again.cuts;
        expect_parts(mine, after, again);
        EXPECT_EQ(again.report.details.rounds, 1);
        for (const Cut& cut : after.tree) {
            EXPECT_EQ(cut.divides, 0);
            EXPECT_TRUE(!plain ||
                        std::ranges::count_if(cut.at, [](double x) { return std::isinf(x); }) >= 2);
        }
    }
}

TEST(SpreadReuse, balances_anew_beyond_the_tolerance_and_for_exact_cuts) {
    HeldPoints all = uneven_cloud(2, true);
    Options options = spread_options(num_ranks(), 1.05);
    const Balance first = balance(Share(all).points(), MPI_COMM_WORLD, options);
    std::vector<int> axes;
    for (const Cut& cut : first.cuts.tree) axes.push_back(cut.axis);
    drift(0.3, all);
    const Share mine(all);
    for (const Refine refine : {Refine::tolerance, Refine::exact}) {
        options.refine = refine;
        Options along = options;
        along.expert.axes.order = AxisOrder::given(axes);
        const Balance fresh = balance(mine.points(), MPI_COMM_WORLD, along);
        const Balance again = balance(mine.points(), MPI_COMM_WORLD, options, first.cuts);
        if (num_ranks() > 2) {
            EXPECT_EQ(again.parts, fresh.parts);
        }
        EXPECT_LE(again.report.imbalance, 1.05);
        EXPECT_TRUE(num_ranks() <= 2 || test::same_cuts(again.cuts, fresh.cuts));
    }
    // Rank 0 makes the parts, from cuts of many.
    options.expert.max_root_parts = 1000;
    options.refine = Refine::tolerance;
    EXPECT_LE(balance(mine.points(), MPI_COMM_WORLD, options, first.cuts).report.imbalance, 1.05);
}

TEST(SpreadReuse, counts_points_without_weight_and_keeps_the_cuts_without_points) {
    HeldPoints all = uneven_cloud(2, false);
    all.weights.assign(all.count(), 0.0);
    const Options options = spread_options(num_ranks(), 1.1);
    const Share mine(all);
    const Balance first = balance(mine.points(), MPI_COMM_WORLD, options);
    const Cuts& whole = first.cuts;
    const Balance again = balance(mine.points(), MPI_COMM_WORLD, options, first.cuts);
    EXPECT_TRUE(again.report.details.all_weights_zero);
    EXPECT_EQ(again.parts, first.parts);
    EXPECT_NEAR(again.report.imbalance, imbalance_by_look_up(all, whole), 1e-9);

    const std::vector<double> none;
    const Balance empty = balance(Points(none, 2), MPI_COMM_WORLD, options, first.cuts);
    EXPECT_TRUE(test::same_cuts(empty.cuts, whole));
    EXPECT_EQ(empty.report.details.rounds, 0);
}

TEST(SpreadReuse, measures_weights_so_small_that_a_mean_part_is_no_double) {
    HeldPoints all = uneven_cloud(2, true);
    for (double& weight : all.weights) weight = weight > 1.45 ? 5e-324 : 0;
    const Share mine(all);
    const Options options = spread_options(num_ranks(), 1.2);
    const Balance first = balance(mine.points(), MPI_COMM_WORLD, options);
    const Balance again = balance(mine.points(), MPI_COMM_WORLD, options, first.cuts);
    EXPECT_EQ(again.report.details.rounds, 1);
    EXPECT_NEAR(again.report.imbalance, imbalance_by_look_up(all, again.cuts), 1e-9);
}

TEST(SpreadReuse, tells_all_ranks_what_is_wrong_on_one) {
    if (num_ranks() <= 2) GTEST_SKIP() << "needs three ranks";
    HeldPoints all = uneven_cloud(2, false);
    const Options options = spread_options(num_ranks(), 1.1);
    Share mine(all);
    const Balance first = balance(mine.points(), MPI_COMM_WORLD, options);
    const auto expect = [&](const std::string& text, const Cuts& previous, const Options& asked) {
        test::expect_same_error([&] { balance(mine.points(), MPI_COMM_WORLD, asked, previous); },
                                text);
        EXPECT_EQ(balance(Share(all).points(), MPI_COMM_WORLD, options, first.cuts).parts,
                  first.parts);
    };
    const bool is_last = test::is_last_rank();
    Cuts lacking = first.cuts;
    if (rank() == 0) lacking.tree.pop_back();
    expect("rank 0: previous cuts must have", lacking, options);
    Cuts other_cuts = first.cuts;
    if (is_last) other_cuts.tree.back().at.fill(7);
    expect("previous differs", other_cuts, options);
    Options other = options;
    if (is_last) other.refine = Refine::exact;
    expect("refine differs", first.cuts, other);
    other = options;
    if (is_last) other.expert.max_root_parts = 1000;
    expect("max_root_parts differs", first.cuts, other);
    if (is_last) mine.coordinates[7] = std::nan("");
    expect("is NaN or infinite", first.cuts, options);
}

}  // namespace
}  // namespace rrcb
