// Points that each rank holds by the last call: they come to rest.
#include "held_points.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rrcb {
namespace {

using test::balance_and_move;
using test::HeldPoints;
using test::imbalance_of;
using test::num_ranks;
using test::Share;
using test::Step;

Options with(Refine refine, int support_mesh = 0) {
    Options options;
    options.refine = refine;
    options.expert.cells_per_axis = support_mesh;
    return options;
}

/// Points move in the first `most_moves` calls at most, and never to a worse balance.
void expect_rest(HeldPoints all, const Options& options, int most_moves) {
    balance_and_move(all, options);
    double before = imbalance_of(all, options);
    int num_moves = 1;
    for (int call = 2; call <= most_moves + 3; ++call) {
        const Step step = balance_and_move(all, options);
        const double now = imbalance_of(all, options);
        if (step.num_moved > 0) {
            ++num_moves;
            EXPECT_LE(call, most_moves) << step.num_moved << " points";
            EXPECT_LE(now, before) << "call " << call;
        }
        if (step.balance.report.kept) {
            EXPECT_EQ(step.num_moved, 0u);
            EXPECT_EQ(step.balance.report.imbalance, now);
        }
        EXPECT_EQ(step.num_strays, 0);
        before = now;
    }
}

// Exact cuts are found at once; estimated ones may gain from the second estimate, of sorted points.
TEST(PointsAtRest, of_a_slope_move_in_two_calls_more_at_most) {
    for (const HeldPoints& slope : {test::lattice_slope(0.2121), test::random_slope(54464)})
        for (const int mesh : {0, 4, 8})
            for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
                SCOPED_TRACE(std::to_string(slope.count()) + " points, mesh " +
                             std::to_string(mesh) + ", refine " +
                             std::to_string(static_cast<int>(refine)));
                expect_rest(slope, with(refine, mesh), refine == Refine::exact ? 2 : 3);
            }
}

HeldPoints random_points(std::size_t count, int dimension, unsigned seed) {
    HeldPoints all{dimension, test::uniform_cloud(count, dimension, seed)};
    all.scatter();
    return all;
}

TEST(PointsAtRest, of_any_dimension_and_weight_rest) {
    for (const int dimension : {1, 2, 3}) {
        HeldPoints all = random_points(6000, dimension, 3);
        for (const Refine refine : {Refine::none, Refine::tolerance}) {
            SCOPED_TRACE(std::to_string(dimension) + "-D, refine " +
                         std::to_string(static_cast<int>(refine)));
            all.weights.clear();
            expect_rest(all, with(refine), 3);
            for (std::size_t i = 0; i < all.count(); ++i)
                all.weights.push_back(1 + static_cast<double>(i % 13));
            expect_rest(all, with(refine), 3);
            std::ranges::fill(all.weights, 0);
            expect_rest(all, with(refine), 3);
        }
    }
}

/// A layer of 10 x 0.2 under drops that make its box square.
HeldPoints layer_with_drops(std::size_t count) {
    HeldPoints all{2, test::uniform_cloud(count, 2, 12)};
    for (std::size_t i = 0; i < count; ++i) {
        double* x = &all.coordinates[2 * i];
        x[0] *= 10;
        x[1] *= i % 200 == 0 ? 10 : 0.2;
    }
    all.scatter();
    return all;
}

TEST(PointsAtRest, in_a_layer_under_drops_rest_in_columns) {
    expect_rest(layer_with_drops(8000), with(Refine::tolerance), 3);
    HeldPoints all = layer_with_drops(8000);
    for (int call = 0; call < 8; ++call) {
        const Step step = balance_and_move(all, with(Refine::tolerance));
        // Columns are at least five times as wide as high for up to 10 ranks.
        for (const Cut& cut : step.balance.cuts.tree) EXPECT_EQ(cut.axis, 0);
        // Small moves do not turn the cuts.
        for (std::size_t i = 0; i < all.coordinates.size(); ++i)
            all.coordinates[i] *=
                1 + 1e-3 * static_cast<double>((i + 7 * static_cast<std::size_t>(call)) % 5);
    }
}

TEST(PointsAtRest, in_parts_of_given_sizes_rest) {
    Options options = with(Refine::tolerance);
    for (int part = 0; part < num_ranks(); ++part) options.part_sizes.push_back(part % 3);
    if (num_ranks() == 1) options.part_sizes = {1};
    expect_rest(random_points(9000, 2, 4), options, 3);
    options.refine = Refine::none;
    expect_rest(random_points(9000, 2, 4), options, 4);
}

TEST(PointsAtRest, in_given_axes_or_between_planes_rest) {
    Options plain = with(Refine::tolerance);
    plain.expert.axes.plain = true;
    expect_rest(random_points(9000, 2, 5), plain, 3);
    Options grouped = with(Refine::tolerance);
    grouped.expert.axes.order = AxisOrder::grouped({1, 0});
    expect_rest(random_points(9000, 2, 5), grouped, 3);
    Options given = with(Refine::tolerance);
    given.expert.axes.order =
        AxisOrder::given(std::vector<int>(static_cast<std::size_t>(num_ranks() - 1), 1));
    expect_rest(random_points(9000, 2, 5), given, 3);
}

TEST(PointsAtRest, in_groups_of_parts_rest) {
    Options options = with(Refine::tolerance);
    for (const TreeShape tree : {TreeShape{2, true}, TreeShape{3, false}}) {
        options.expert.tree = tree;
        expect_rest(random_points(9000, 2, 5), options, 3);
    }
}

TEST(PointsAtRest, fewer_than_parts_rest) {
    for (const std::size_t count : {1u, 2u, 3u, 5u})
        for (const Refine refine : {Refine::none, Refine::tolerance})
            expect_rest(random_points(count, 2, 6), with(refine), 4);
}

TEST(PointsAtRest, in_few_places_rest) {
    HeldPoints all{2, {}};
    for (int i = 0; i < 1000; ++i)
        all.coordinates.insert(all.coordinates.end(), {double(i % 3), double(i % 5)});
    all.scatter();
    for (const Refine refine : {Refine::none, Refine::tolerance}) expect_rest(all, with(refine), 4);
}

TEST(PointsAtRest, in_one_place_and_divided_rest) {
    HeldPoints all{2, std::vector<double>(2000, 0.5)};
    all.scatter();
    Options options = with(Refine::tolerance);
    options.expert.coincident = Coincident::divide;
    balance_and_move(all, options);
    for (int call = 2; call <= 4; ++call) {
        const Step step = balance_and_move(all, options);
        EXPECT_EQ(step.num_moved, 0u);
        EXPECT_EQ(step.balance.report.kept, num_ranks() > 1);
        EXPECT_EQ(step.balance.report.details.coincident_cuts, num_ranks() - 1);
    }
}

TEST(PointsAtRest, report_what_their_parts_weigh) {
    HeldPoints all = random_points(5000, 2, 7);
    const Options options = with(Refine::tolerance);
    // Each of the first calls may halve what the one before left.
    for (int call = 1; call <= 4; ++call) balance_and_move(all, options);
    const Step step = balance_and_move(all, options);
    const Report& report = step.balance.report;
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    EXPECT_TRUE(report.kept);
    EXPECT_TRUE(report.within_tolerance);
    EXPECT_EQ(report.imbalance, imbalance_of(all, options));
    ASSERT_EQ(report.part_weights.size(), static_cast<std::size_t>(num_ranks()));
    for (int part = 0; part < num_ranks(); ++part)
        EXPECT_EQ(report.part_weights[static_cast<std::size_t>(part)],
                  static_cast<double>(std::ranges::count(all.owners, part)));
}

TEST(PointsAtRest, first_scattered_are_not_kept_and_counted_only_where_asked) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    HeldPoints all = random_points(5000, 2, 8);
    const Share mine(all);
    for (const Refine refine : {Refine::none, Refine::tolerance}) {
        const Report report = balance(mine.points(), MPI_COMM_WORLD, with(refine)).report;
        EXPECT_FALSE(report.kept);
        EXPECT_EQ(std::isnan(report.imbalance), refine == Refine::none);
    }
}

/// Ranks hold slabs of a unit square, all of the same weight.
HeldPoints slabs(std::size_t count) {
    HeldPoints all = random_points(count, 2, 9);
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(all.coordinates[2 * i]);
    std::ranges::sort(values);
    for (std::size_t i = 0; i < count; ++i) {
        const auto below =
            std::ranges::lower_bound(values, all.coordinates[2 * i]) - values.begin();
        all.owners[i] = static_cast<Part>(below * num_ranks() / static_cast<long>(count));
    }
    return all;
}

TEST(PointsAtRest, in_balanced_slabs_become_blocks) {
    if (num_ranks() < 3) GTEST_SKIP() << "two slabs are blocks";
    HeldPoints all = slabs(6000);
    const Step step = balance_and_move(all, with(Refine::tolerance));
    EXPECT_FALSE(step.balance.report.kept);
    EXPECT_GT(step.num_moved, 1000u);
    Options given = with(Refine::tolerance);
    given.expert.axes.order =
        AxisOrder::given(std::vector<int>(static_cast<std::size_t>(num_ranks() - 1), 0));
    HeldPoints asked_for = slabs(6000);
    EXPECT_EQ(balance_and_move(asked_for, given).num_moved, 0u);
}

TEST(PointsAtRest, on_renumbered_ranks_keep_their_cuts) {
    if (num_ranks() < 2) GTEST_SKIP() << "needs two ranks";
    HeldPoints all = random_points(4000, 2, 10);
    const Options options = with(Refine::tolerance);
    for (int call = 1; call <= 2; ++call) balance_and_move(all, options);
    for (Part& owner : all.owners) owner = num_ranks() - 1 - owner;
    const Share mine(all);
    const Balance result = balance(mine.points(), MPI_COMM_WORLD, options);
    for (const Part part : result.parts) EXPECT_EQ(part, num_ranks() - 1 - test::rank());
    EXPECT_FALSE(result.report.kept) << "part r is not on rank r, so points move";
}

/// A tolerance that can be met is met, whatever the ranks hold.
TEST(DriftingPoints, stay_within_the_tolerance_and_their_look_ups_agree) {
    for (const double tolerance : {1.0, 1.01, 1.1}) {
        HeldPoints all = random_points(static_cast<std::size_t>(960 * num_ranks()), 2, 11);
        Options options = with(Refine::tolerance);
        options.imbalance_tolerance = tolerance;
        int num_kept = 0;
        for (int call = 0; call < 12; ++call) {
            const Step step = balance_and_move(all, options);
            num_kept += step.balance.report.kept ? 1 : 0;
            EXPECT_EQ(step.num_strays, 0);
            EXPECT_LE(imbalance_of(all, options), tolerance);
            EXPECT_TRUE(step.balance.report.within_tolerance);
            for (std::size_t i = 0; i < all.count(); ++i)
                all.coordinates[2 * i] += 2e-4 * all.coordinates[2 * i + 1];
        }
        EXPECT_TRUE(num_kept > 0 || tolerance < 1.1 || num_ranks() == 1);
    }
}

}  // namespace
}  // namespace rrcb
