// Calls that start from the cuts of an earlier one: these stay while they are good enough, at the
// cost of one assignment and one count.
#include "../support/same_error.hpp"
#include "reuse_cases.hpp"

#include <rrcb/error.hpp>
#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

namespace {

std::atomic<std::size_t> bytes_allocated = 0;
int num_collectives = 0;

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    bytes_allocated += size;
    return std::malloc(size);
}
[[gnu::noinline]] void* operator new(std::size_t size) {
    if (void* memory = operator new(size, std::nothrow)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

int MPI_Bcast(void* buffer, int count, MPI_Datatype type, int root, MPI_Comm comm) {
    ++num_collectives;
    return PMPI_Bcast(buffer, count, type, root, comm);
}
int MPI_Reduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op, int root,
               MPI_Comm comm) {
    ++num_collectives;
    return PMPI_Reduce(in, out, count, type, op, root, comm);
}
int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op,
                  MPI_Comm comm) {
    ++num_collectives;
    return PMPI_Allreduce(in, out, count, type, op, comm);
}

namespace rrcb {
namespace {

using test::cloud;
using test::HeldPoints;
using test::num_ranks;
using test::rank;
using test::same_cuts;
using test::Share;
using test::weights_by_look_up;
using test::with_parts;

TEST(Reuse, keeps_cuts_within_the_tolerance_and_tells_what_their_parts_weigh) {
    for (const bool is_lattice : {false, true})
        for (const int dimension : {1, 2, 3})
            for (const int num_parts : {1, 5, 24}) {
                HeldPoints all = cloud(dimension, 3000, is_lattice && dimension > 1);
                for (const double weight : {-1.0, 0.0, 0.25}) {
                    if (weight >= 0) all.weights.assign(all.count(), weight);
                    const Share mine(all);
                    const Options options = with_parts(num_parts, 1.2);
                    const Balance first = balance(mine.points(), MPI_COMM_WORLD, options);
                    const Points points = mine.points();
                    const Balance second = balance(points, MPI_COMM_WORLD, options, first.cuts);
                    EXPECT_TRUE(same_cuts(second.cuts, first.cuts));
                    for (std::size_t i = 0; i < points.count; ++i)
                        ASSERT_EQ(second.parts[i], part_of(first.cuts, points.position(i)));
                    const auto weights = weights_by_look_up(all, first.cuts);
                    EXPECT_EQ(second.report.part_weights, weights);
                    EXPECT_EQ(second.report.imbalance, imbalance(weights));
                    EXPECT_TRUE(second.report.within_tolerance);
                    EXPECT_EQ(second.report.details.num_points, 3000);
                    EXPECT_EQ(second.report.details.all_weights_zero, weight == 0);
                }
            }
}

TEST(Reuse, without_refinement_keeps_cuts_within_the_tolerance_only) {
    const HeldPoints all = cloud(2, 2000, false);
    const Share mine(all);
    Options options = with_parts(3, 1.2);
    options.refine = Refine::none;
    const Cuts first = balance(mine.points(), MPI_COMM_WORLD, options).cuts;
    const Balance kept = balance(mine.points(), MPI_COMM_WORLD, options, first);
    EXPECT_TRUE(same_cuts(kept.cuts, first));
    EXPECT_EQ(kept.report.part_weights, weights_by_look_up(all, first));
    EXPECT_TRUE(kept.report.within_tolerance);
    const Cuts poor{
        2, 3, {Cut{0, 0, {0.1, -INFINITY, -INFINITY}}, Cut{1, 0, {-INFINITY, 0.9, -INFINITY}}}};
    const Balance made = balance(mine.points(), MPI_COMM_WORLD, options, poor);
    EXPECT_LT(imbalance(weights_by_look_up(all, made.cuts)), 1.2);
    for (std::size_t i = 0; i < made.parts.size(); ++i)
        ASSERT_EQ(made.parts[i], part_of(made.cuts, mine.points().position(i)));
}

TEST(Reuse, of_the_same_axes_makes_the_cuts_of_a_call_from_nothing) {
    for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
        HeldPoints all = cloud(2, 6000, false);
        Options options = with_parts(7, 1.02);
        options.refine = refine;
        options.expert.axes.order = AxisOrder::given({0, 1, 1, 0, 1, 1});
        const Cuts first = balance(Share(all).points(), MPI_COMM_WORLD, options).cuts;
        for (double& x : all.coordinates) x *= x;
        const Share mine(all);
        const Balance second = balance(mine.points(), MPI_COMM_WORLD, options, first);
        const Balance anew = balance(mine.points(), MPI_COMM_WORLD, options);
        EXPECT_FALSE(same_cuts(second.cuts, first));
        EXPECT_TRUE(same_cuts(second.cuts, anew.cuts));
        EXPECT_EQ(second.parts, anew.parts);
        const int more = refine == Refine::tolerance ? 1 : 0;
        EXPECT_EQ(second.report.details.rounds, anew.report.details.rounds + more);
    }
}

TEST(Reuse, takes_two_collectives_and_no_memory_that_grows_with_the_points) {
    std::size_t bytes[2] = {0, 0};
    for (const std::size_t count : {std::size_t{1000}, std::size_t{100000}}) {
        const std::vector<double> mine =
            test::uniform_cloud(count, 2, static_cast<unsigned>(rank() + 1));
        const Points points(mine, 2);
        const Options options = with_parts(8, 1.05);
        const Balance first = balance(points, MPI_COMM_WORLD, options);
        num_collectives = 0;
        const std::size_t before = bytes_allocated;
        const Balance second = balance(points, MPI_COMM_WORLD, options, first.cuts);
        bytes[count == 1000 ? 0 : 1] = bytes_allocated - before - count * sizeof(Part);
        EXPECT_LE(num_collectives, 2);
        EXPECT_EQ(second.report.details.rounds, 1);
    }
    EXPECT_EQ(bytes[0], bytes[1]);
}

TEST(Reuse, keeps_the_axes_of_cuts_beyond_the_tolerance) {
    for (const double tolerance : {1.01, 1.1}) {
        HeldPoints all = cloud(2, 6000, false);
        const Options options = with_parts(7, tolerance);
        const Share before(all);
        const Cuts first = balance(before.points(), MPI_COMM_WORLD, options).cuts;
        for (double& x : all.coordinates) x *= x;
        const Share mine(all);
        const Balance second = balance(mine.points(), MPI_COMM_WORLD, options, first);
        EXPECT_LE(imbalance(weights_by_look_up(all, second.cuts)), tolerance);
        EXPECT_EQ(second.report.part_weights, weights_by_look_up(all, second.cuts));
        EXPECT_FALSE(same_cuts(second.cuts, first));
        for (std::size_t k = 0; k < first.tree.size(); ++k)
            EXPECT_EQ(second.cuts.tree[k].axis, first.tree[k].axis);
    }
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
        options.expert.axes.order = AxisOrder::longest();
        const Balance first = balance(mine.points(), MPI_COMM_WORLD, options);
        const Balance again = balance(mine.points(), MPI_COMM_WORLD, options, first.cuts);
        constexpr double round_off = 1e-12;
        if (again.report.imbalance < first.report.imbalance * (1 - round_off)) continue;
        EXPECT_EQ(again.parts, first.parts) << "seed " << seed;
        EXPECT_TRUE(same_cuts(again.cuts, first.cuts)) << "seed " << seed;
        EXPECT_NEAR(again.report.imbalance, first.report.imbalance, 1e-9);
    }
}

TEST(Reuse, throws_on_every_rank_what_is_wrong_on_one) {
    const Options options = with_parts(4, 1.05);
    std::vector<double> mine = test::uniform_cloud(700, 2, static_cast<unsigned>(rank() + 1));
    const Cuts cuts = balance(Points(mine, 2), MPI_COMM_WORLD, options).cuts;
    const auto call = [&](const Cuts& previous, std::span<const double> weights = {}) {
        balance(Points(mine, 2, weights), MPI_COMM_WORLD, options, previous);
    };
    const bool is_last = test::is_last_rank();
    if (num_ranks() > 1) {
        Cuts others = cuts;
        if (is_last) others.tree[1].at.fill(7);
        test::expect_same_error([&] { call(others); }, "previous differs between rank");
        test::expect_same_error(
            [&] {
                balance(Points(mine, 2), MPI_COMM_WORLD, with_parts(is_last ? 5 : 4, 1.05),
                        is_last ? Cuts{2, 5, {Cut{}, Cut{}, Cut{}, Cut{}}} : cuts);
            },
            "num_parts differs between rank");
        test::expect_same_error(
            [&] {
                if (is_last)
                    balance(Points(mine, 2), MPI_COMM_WORLD, options);
                else
                    call(cuts);
            },
            "previous differs between rank");
    }
    test::expect_same_error(
        [&] {
            call(is_last ? Cuts{2, 3, {Cut{}, Cut{}}} : cuts);
        },
        "previous cuts have 3 parts, not 4; pass no cuts ({}; None; in C rrcb_set_cuts(balancer, "
        "NULL)), or set "
        "num_parts to 3 to keep their parts");
    std::vector<double> weights(700, 1.0);
    if (is_last) weights[3] = -1;
    test::expect_same_error([&] { call(cuts, weights); }, "weight of point 3");
    std::vector<double> giant(700, is_last ? 2e305 : 1e305);
    if (num_ranks() > 2) test::expect_same_error([&] { call(cuts, giant); }, "overflows");
    if (is_last) mine[601] = std::nan("");
    test::expect_same_error([&] { call(cuts); }, "coordinate of point 300 on axis 1");
    if (is_last) mine[601] = 0.5;
    call(cuts);
}

TEST(Reuse, goes_on_where_ranks_are_empty) {
    HeldPoints all = cloud(2, 500, false);
    std::ranges::fill(all.owners, num_ranks() / 2);
    const Share mine(all);
    const Options options = with_parts(3, 1.05);
    const Cuts cuts = balance(mine.points(), MPI_COMM_WORLD, options).cuts;
    EXPECT_EQ(balance(mine.points(), MPI_COMM_WORLD, options, cuts).report.part_weights,
              weights_by_look_up(all, cuts));
}

/// What a report tells but of the records.
auto told(const Report& report) {
    return std::tuple(report.details.num_points, report.details.total_weight,
                      report.details.estimated_imbalance, std::isnan(report.imbalance),
                      report.within_tolerance, report.part_weights, report.details.least_imbalance,
                      report.details.coincident_cuts, report.kept, report.details.rounds,
                      report.details.all_weights_zero, report.details.num_empty_parts);
}

TEST(Reuse, without_points_tells_what_a_call_from_nothing_does) {
    const HeldPoints all = cloud(2, 500, false);
    const Points none({}, 2);
    for (const bool limited : {false, true}) {
        for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
            Options options = with_parts(3, 1.05);
            options.refine = refine;
            if (limited) options.expert.axes.min_width = {0.1, 0.1};
            const Cuts cuts = balance(Share(all).points(), MPI_COMM_WORLD, options).cuts;
            const Balance empty = balance(none, MPI_COMM_WORLD, options, cuts);
            EXPECT_TRUE(same_cuts(empty.cuts, cuts));
            EXPECT_EQ(told(empty.report), told(balance(none, MPI_COMM_WORLD, options).report))
                << limited << static_cast<int>(refine);
            EXPECT_EQ(empty.report.details.estimated_imbalance, 1);
            EXPECT_EQ(empty.report.imbalance, 1);
            EXPECT_TRUE(empty.report.within_tolerance);
        }
    }
}

}  // namespace
}  // namespace rrcb
