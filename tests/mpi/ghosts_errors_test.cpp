#include "../support/clouds.hpp"
#include "../support/ranks.hpp"
#include "../support/same_error.hpp"
#include "slabs.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/ghosts.hpp>

namespace rrcb {
namespace {

using test::slabs;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Expects an Error with this text on every rank, after which the next call works.
void expect_refusal(const std::string& text, const std::function<void()>& call) {
    test::expect_same_error([&] { call(); }, text);
    const std::vector<double> none;
    EXPECT_EQ(ghost_plan(slabs(), Points(none, 2), MPI_COMM_WORLD, {.cutoff = 1}).num_points, 0u);
}

TEST(Ghosts, within_no_radius_are_refused_on_all_ranks) {
    const std::vector<double> x(2);
    const Points points(x, 2);
    expect_refusal("give one for all points, or one for each",
                   [&] { ghost_plan(slabs(), points, MPI_COMM_WORLD, {}); });
    for (const double radius : {-1.0, std::nan(""), infinity, -infinity}) {
        expect_refusal("the cutoff must be finite",
                       [&] { ghost_plan(slabs(), points, MPI_COMM_WORLD, {.cutoff = radius}); });
        expect_refusal("rank " + std::to_string(num_ranks() - 1) + ": the cutoff must be finite",
                       [&] {
                           ghost_plan(slabs(), points, MPI_COMM_WORLD,
                                      {.cutoff = is_last_rank() ? radius : 1.0});
                       });
    }
}

TEST(Ghosts, of_points_that_have_yet_to_leave_are_refused_on_all_ranks) {
    if (num_ranks() < 2) GTEST_SKIP() << "needs two ranks";
    const std::vector<double> x = test::uniform_cloud(100, 2, static_cast<unsigned>(rank()));
    const Points points(x, 2);
    const Balance made = balance(points, MPI_COMM_WORLD);
    const auto here = transfer(plan(made, MPI_COMM_WORLD), column(x, 2), MPI_COMM_WORLD);
    const Points moved(here, 2);
    // A radius that reaches all parts hides nothing.
    for (const double radius : {0.01, 2.0}) {
        const GhostOptions options{.cutoff = radius};
        expect_refusal("these are the points of the balance, some ",
                       [&] { ghost_plan(made.cuts, points, MPI_COMM_WORLD, options); });
        const Points of_last = is_last_rank() ? points : moved;
        expect_refusal("rank " + std::to_string(num_ranks() - 1) + ": these are the points",
                       [&] { ghost_plan(made.cuts, of_last, MPI_COMM_WORLD, options); });
        EXPECT_EQ(ghost_plan(made.cuts, moved, MPI_COMM_WORLD, options).num_points, moved.count);
    }
    // Points that have moved since, or that are kept where they are, are none of these.
    std::vector<double> drifted = here;
    for (double& value : drifted) value *= 0.99;
    EXPECT_NO_THROW(ghost_plan(made.cuts, Points(drifted, 2), MPI_COMM_WORLD, {.cutoff = 0.1}));
    const Balance again = balance(moved, MPI_COMM_WORLD);
    const auto kept = transfer(plan(again, MPI_COMM_WORLD), column(here, 2), MPI_COMM_WORLD);
    EXPECT_NO_THROW(ghost_plan(again.cuts, Points(kept, 2), MPI_COMM_WORLD, {.cutoff = 0.1}));
}

/// Balances, transfers and finds ghosts several times, each time of the right points.
void expect_loop(std::vector<double> x, const Options& options) {
    for (int step = 0; step < 5; ++step) {
        const Points points(x, 2);
        const Balance made = balance(points, MPI_COMM_WORLD, options);
        x = transfer(plan(made, MPI_COMM_WORLD), column(x, 2), MPI_COMM_WORLD);
        EXPECT_NO_THROW(ghost_plan(made.cuts, Points(x, 2), MPI_COMM_WORLD, {.cutoff = 0.1}));
    }
}

TEST(Ghosts, of_divided_points_are_found_after_a_transfer_that_moves_none) {
    Options options{.expert = {.coincident = Coincident::divide}};
    expect_loop({0.5, 0.5}, options);
    std::vector<double> tenth = test::uniform_cloud(1000, 2, static_cast<unsigned>(rank()));
    std::fill(tenth.begin(), tenth.begin() + 200, 0.5);
    expect_loop(tenth, options);
}

TEST(Ghosts, of_points_that_look_like_those_before_the_transfer_are_found) {
    Options options{.refine = Refine::exact, .expert = {.coincident = Coincident::divide}};
    // Rank 1 passes on one of the coincident points and gets another.
    const std::vector<double> two{0.5, 0.5, 0.5, 0.5};
    expect_loop(rank() == 0 ? two : std::vector<double>(rank() % 2 * 2, 0.5), options);
    for (unsigned seed = 0; seed < 100; ++seed) {
        std::mt19937_64 engine(seed * 100 + static_cast<unsigned>(rank()));
        std::vector<double> x(2 * (engine() % 6));
        for (double& value : x) value = static_cast<double>(engine() % 2);
        options.num_parts = num_ranks() + static_cast<int>(seed % 4);
        expect_loop(x, options);
    }
}

TEST(Ghosts, of_unusable_points_cuts_or_ranks_are_refused_on_all_ranks) {
    const std::vector<double> x{0, is_last_rank() ? std::nan("") : 0};
    expect_refusal("is NaN or infinite",
                   [&] { ghost_plan(slabs(), Points(x, 2), MPI_COMM_WORLD, {.cutoff = 1}); });
    const std::vector<double> right(2);
    const Points points(right, 2);
    expect_refusal("cuts must have the dimension of the points", [&] {
        Cuts cuts = slabs();
        cuts.dimension = is_last_rank() ? 3 : 2;
        ghost_plan(cuts, points, MPI_COMM_WORLD, {.cutoff = 1});
    });
    expect_refusal("the tree must hold one cut less than there are parts", [&] {
        Cuts cuts = slabs();
        if (is_last_rank()) cuts.tree.push_back({});
        ghost_plan(cuts, points, MPI_COMM_WORLD, {.cutoff = 1});
    });
    expect_refusal("must name ranks of this communicator", [&] {
        std::vector<RankRange> ranks(static_cast<std::size_t>(num_ranks()));
        if (is_last_rank()) ranks[0].first_rank = num_ranks();
        ghost_plan(slabs(), points, MPI_COMM_WORLD, {.cutoff = 1, .ranks_of_parts = ranks});
    });
    expect_refusal("one entry for each part", [&] {
        const std::vector<RankRange> ranks(static_cast<std::size_t>(num_ranks() + 1));
        ghost_plan(slabs(), points, MPI_COMM_WORLD, {.cutoff = 1, .ranks_of_parts = ranks});
    });
}

TEST(Ghosts, of_arguments_that_differ_are_refused_on_all_ranks) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const std::vector<double> x(2);
    const Points points(x, 2);
    const int other = is_last_rank() ? 1 : 0;
    expect_refusal("the cutoff differs between rank 0 and rank",
                   [&] { ghost_plan(slabs(), points, MPI_COMM_WORLD, {.cutoff = 1.0 + other}); });
    expect_refusal("the tree of cuts differs between rank 0 and rank", [&] {
        Cuts cuts = slabs();
        cuts.tree[0].at[0] += other;
        ghost_plan(cuts, points, MPI_COMM_WORLD, {.cutoff = 1});
    });
    expect_refusal("ranks_of_parts differs between rank 0 and rank", [&] {
        const std::vector<RankRange> ranks(static_cast<std::size_t>(num_ranks()), {other, 1});
        ghost_plan(slabs(), points, MPI_COMM_WORLD, {.cutoff = 1, .ranks_of_parts = ranks});
    });
}

TEST(Fetch, by_a_plan_that_does_not_hold_together_is_refused_on_all_ranks) {
    const std::vector<double> coordinates{rank() + 0.5, 0};
    const GhostPlan right =
        ghost_plan(slabs(), Points(coordinates, 2), MPI_COMM_WORLD, {.cutoff = 10});
    const std::vector<int> values(1);
    const auto expect = [&](const std::string& text, const std::function<void(GhostPlan&)>& spoil) {
        GhostPlan wrong = right;
        if (is_last_rank()) spoil(wrong);
        expect_refusal("rank " + std::to_string(num_ranks() - 1) + ": " + text,
                       [&] { fetch(wrong, values, MPI_COMM_WORLD); });
    };
    expect("send_indices of the plan must be below num_points; give the plan as it was made",
           [](GhostPlan& wrong) {
               wrong.num_points = 0;
               wrong.send = {{0, 1}};
               wrong.send_indices = {0};
           });
    expect("the counts of the plan do not add up",
           [](GhostPlan& wrong) { wrong.send_indices.push_back(0); });
    expect("the plan names rank " + std::to_string(num_ranks()), [](GhostPlan& wrong) {
        wrong.receive.push_back({num_ranks(), 1});
    });
    expect("the plan names rank -1", [](GhostPlan& wrong) {
        wrong.receive.insert(wrong.receive.begin(), {-1, 1});
    });
    expect("rank " + std::to_string(num_ranks() - 1) + " sends 0 points, not 1",
           [](GhostPlan& wrong) {
               wrong.receive.push_back({rank(), 1});
           });
}

TEST(Fetch, of_a_column_of_another_type_is_refused_on_all_ranks) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const std::vector<double> coordinates{rank() + 0.5, 0};
    const GhostPlan plan =
        ghost_plan(slabs(), Points(coordinates, 2), MPI_COMM_WORLD, {.cutoff = 10});
    const std::vector<float> numbers(1);
    const std::vector<int> whole(1);
    expect_refusal("column 0 (the first is 0) has 1 per point, whole numbers of 4 bytes, but", [&] {
        if (is_last_rank())
            fetch(plan, whole, MPI_COMM_WORLD);
        else
            fetch(plan, numbers, MPI_COMM_WORLD);
    });
}

}  // namespace
}  // namespace rrcb
