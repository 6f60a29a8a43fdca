// How far cuts move, and how much with them, where a call starts from those of an earlier one.
#include "reuse_cases.hpp"

#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace rrcb {
namespace {

using test::cloud;
using test::HeldPoints;
using test::same_cuts;
using test::Share;
using test::weights_by_look_up;
using test::with_parts;

/// Weight of the points that two sets of cuts put into different parts.
double weight_moved(const HeldPoints& all, const Cuts& before, const Cuts& after) {
    const Points points = interleaved_points(all.coordinates, all.dimension, all.weights);
    double moved = 0;
    for (std::size_t i = 0; i < points.count; ++i) {
        const Vector x = points.position(i);
        if (part_of(before, x) != part_of(after, x)) moved += points.weight(i);
    }
    return moved;
}

/// The least weight that any cut of points on a line between two parts has to move from `before`,
/// so that both are within the tolerance: all cuts are tried.
double least_moved(const HeldPoints& all, const Cuts& before, double tolerance) {
    double least = std::numeric_limits<double>::infinity();
    for (const double x : all.coordinates) {
        const Cuts tried{1, 2, {Cut{0, 0, {x, -INFINITY, -INFINITY}}}};
        if (imbalance(weights_by_look_up(all, tried)) > tolerance) continue;
        least = std::min(least, weight_moved(all, before, tried));
    }
    return least;
}

TEST(Reuse, moves_a_cut_no_further_than_the_tolerance_asks_for) {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        HeldPoints all{1, test::uniform_cloud(300, 1, seed)};
        std::mt19937_64 engine(seed);
        for (std::size_t i = 0; i < all.count(); ++i)
            all.weights.push_back(seed % 3 == 0 ? 1 : test::uniform(engine, 0.5, 1.5));
        all.scatter();
        const Share mine(all);
        for (const double tolerance : {1.02, 1.1}) {
            for (const double at : {0.1, 0.43, 0.61, 0.95}) {
                const Cuts before{1, 2, {Cut{0, 0, {at, -INFINITY, -INFINITY}}}};
                const Balance result =
                    balance(mine.points(), with_parts(2, tolerance), before, MPI_COMM_WORLD);
                EXPECT_LE(imbalance(weights_by_look_up(all, result.cuts)), tolerance);
                const double total = result.report.details.total_weight;
                // An eighth of what is allowed is room for the search, and points are whole.
                const double room = total * (tolerance - 1) / 8 + 3;
                const double least = least_moved(all, before, tolerance);
                EXPECT_LE(weight_moved(all, before, result.cuts), least + room)
                    << "from " << at << ", tolerance " << tolerance;
            }
        }
    }
}

bool same_below(const Cuts& a, const Cuts& b, std::size_t node, int num_parts) {
    for (std::size_t k = node; k + 1 < node + static_cast<std::size_t>(num_parts); ++k)
        if (a.tree[k].at != b.tree[k].at) return false;
    return true;
}

TEST(Reuse, leaves_cuts_alone_whose_parts_are_good) {
    // Points leave the first quarter of a square for the second, which are one subtree of four.
    HeldPoints all = cloud(2, 20000, false);
    const Options options = with_parts(16, 1.05);
    const Cuts before = balance(Share(all).points(), options, {}, MPI_COMM_WORLD).cuts;
    std::mt19937_64 engine(8);
    for (std::size_t i = 0; i < all.count(); ++i) {
        double* x = &all.coordinates[2 * i];
        const bool in_first = part_of(before, {x[0], x[1], 0}) == 0;
        if (in_first && engine() % 2 == 0) x[1] *= 0.9;
        if (in_first && engine() % 4 == 0) all.coordinates[2 * i] = x[0] * 0.5;
    }
    for (std::size_t i = 0; i < 150; ++i)
        all.coordinates.insert(all.coordinates.end(), {0.01 + 1e-4 * static_cast<double>(i), 0.01});
    all.scatter();
    const Share mine(all);
    const Balance result = balance(mine.points(), options, before, MPI_COMM_WORLD);
    EXPECT_LE(imbalance(weights_by_look_up(all, result.cuts)), 1.05);
    EXPECT_EQ(result.cuts.tree[0].at, before.tree[0].at);
    EXPECT_TRUE(same_below(before, result.cuts, 8, 8)) << "the upper half";
    EXPECT_FALSE(same_below(before, result.cuts, 0, 16));
    EXPECT_LT(weight_moved(all, before, result.cuts), 400);
    for (std::size_t i = 0; i < result.parts.size(); ++i)
        ASSERT_EQ(result.parts[i], part_of(result.cuts, mine.points().position(i)));
}

TEST(Reuse, moves_no_points_at_rest_unless_parts_become_more_even) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        HeldPoints all{1 + static_cast<int>(seed % 3), {}};
        all.coordinates = test::uniform_cloud(1 + seed, all.dimension, seed);
        std::mt19937_64 engine(seed);
        for (std::size_t i = 0; i < all.count(); ++i)
            all.weights.push_back(seed % 2 == 0 ? 1 : test::uniform(engine, 0.5, 1.5));
        all.scatter();
        const Share mine(all);
        Options options = with_parts(static_cast<int>(2 + seed % 17), 1.001);
        options.axes.order = AxisOrder::longest();
        const Balance first = balance(mine.points(), options, {}, MPI_COMM_WORLD);
        const Balance again = balance(mine.points(), options, first.cuts, MPI_COMM_WORLD);
        constexpr double round_off = 1e-12;
        if (again.report.imbalance < first.report.imbalance * (1 - round_off)) continue;
        EXPECT_EQ(again.parts, first.parts) << "seed " << seed;
        EXPECT_TRUE(same_cuts(again.cuts, first.cuts)) << "seed " << seed;
        EXPECT_NEAR(again.report.imbalance, first.report.imbalance, 1e-9);
    }
}

TEST(Reuse, of_a_drifting_cloud_moves_half_of_what_exact_cuts_do_at_most) {
    HeldPoints all = cloud(2, 20000, false);
    Options options = with_parts(8, 1.05);
    Options exact = options;
    exact.refine = Refine::exact;
    Cuts cuts = balance(Share(all).points(), exact, {}, MPI_COMM_WORLD).cuts;
    double moved = 0;
    double moved_by_exact = 0;
    int num_moves = 0;
    for (int call = 0; call < 20; ++call) {
        for (std::size_t i = 0; i < all.count(); ++i) {
            double* x = &all.coordinates[2 * i];
            x[0] += 0.01 * x[1] * (1 - x[0]);
        }
        const Share mine(all);
        const Balance next = balance(mine.points(), options, cuts, MPI_COMM_WORLD);
        EXPECT_LE(imbalance(weights_by_look_up(all, next.cuts)), 1.05);
        if (!same_cuts(next.cuts, cuts)) {
            ++num_moves;
            moved += weight_moved(all, cuts, next.cuts);
            const Balance other = balance(mine.points(), exact, cuts, MPI_COMM_WORLD);
            moved_by_exact += weight_moved(all, cuts, other.cuts);
        }
        cuts = next.cuts;
    }
    EXPECT_GT(num_moves, 0);
    EXPECT_LE(moved, moved_by_exact / 2) << num_moves;
    RecordProperty("moved_share_of_exact", std::to_string(moved / moved_by_exact));
}

/// A few points for each part, of weights over four decades.
HeldPoints heavy_points(int dimension, int num_parts, std::mt19937_64& engine) {
    const std::size_t count = static_cast<std::size_t>(num_parts) * (1 + engine() % 12);
    HeldPoints all{dimension,
                   test::uniform_cloud(count, dimension, static_cast<unsigned>(engine()))};
    for (std::size_t i = 0; i < count; ++i)
        all.weights.push_back(std::pow(10, test::uniform(engine, 0, 4)));
    all.scatter();
    return all;
}

TEST(Reuse, takes_other_axes_if_those_of_earlier_cuts_miss_a_tolerance_by_far) {
    std::mt19937_64 engine(3);
    int num_turned = 0;
    for (int round = 0; round < 200; ++round) {
        const int dimension = 2 + round % 2;
        const int num_parts = 2 + static_cast<int>(engine() % 12);
        Options options = with_parts(num_parts, round % 4 == 0 ? 1.5 : 1.001);
        options.refine = round % 3 == 0 ? Refine::exact : Refine::tolerance;
        const Share before(heavy_points(dimension, num_parts, engine));
        const Cuts first = balance(before.points(), options, {}, MPI_COMM_WORLD).cuts;
        const HeldPoints all = heavy_points(dimension, num_parts, engine);
        const Share mine(all);
        const Balance again = balance(mine.points(), options, first, MPI_COMM_WORLD);
        const double reached = again.report.imbalance;
        EXPECT_NEAR(imbalance(weights_by_look_up(all, again.cuts)), reached, 1e-9 * reached);
        options.refine = Refine::exact;
        const double exact = balance(mine.points(), options, {}, MPI_COMM_WORLD).report.imbalance;
        const double least =
            std::max(options.imbalance_tolerance, again.report.details.least_imbalance);
        // Less than a twentieth of what the tolerance allows is no gain.
        const double no_gain = (options.imbalance_tolerance - 1) / 20 + 1e-9 * exact;
        EXPECT_LE(reached, std::max(1.25 * least, exact + no_gain));
        const bool has_turned =
            !std::ranges::equal(first.tree, again.cuts.tree, {}, &Cut::axis, &Cut::axis);
        num_turned += has_turned ? 1 : 0;
    }
    EXPECT_GT(num_turned, 0);
    EXPECT_LT(num_turned, 150);
}

}  // namespace
}  // namespace rrcb
