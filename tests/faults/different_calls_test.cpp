// A rank that makes another call than the others: every rank gets an error that names both calls,
// and the next call is right.
#include "collective/watch_mpi.hpp"
#include "ranks.hpp"
#include "same_error.hpp"

#include <rrcb/experimental/cost.hpp>
#include <rrcb/experimental/verify.hpp>
#include <rrcb/paper.hpp>
#include <rrcb/rrcb.h>
#include <rrcb/rrcb.hpp>

namespace rrcb {
namespace {

const MPI_Comm world = MPI_COMM_WORLD;

/// Points of a rank, and all that calls with them need.
struct Input {
    std::vector<double> coordinates;
    Points points;
    Balance balanced;
    Plan lists;
    GhostPlan near;
    Groups clusters;
    std::vector<RankRange> ranks;
    std::vector<std::uint64_t> keys;
    std::vector<double> of_ghosts;
    std::optional<Controller> controller;
    std::optional<experimental::CostModel> model;

    Input() {
        for (int i = 0; i < 40; ++i)
            for (const double step : {0.618, 0.755}) {
                const double x = step * (40 * rank() + i);
                coordinates.push_back(x - static_cast<int>(x));
            }
        points = Points(coordinates, 2);
        for (int r = 0; r < num_ranks(); ++r) ranks.push_back({r, 1});
        for (std::uint64_t i = 0; i < 40; ++i) keys.push_back(i / 2);
        balanced = balance(points, world);
        balanced.cuts = unstamped(balanced.cuts);  // the points stay where they are
        lists = plan(balanced, world);
        near = ghost_plan(balanced.cuts, points, world, {.cutoff = 0.1});
        clusters = groups(points, keys, world);
        of_ghosts.resize(total_of(near.receive));
    }

    static std::size_t total_of(const std::vector<RankCount>& counts) {
        std::size_t total = 0;
        for (const RankCount& one : counts) total += one.count;
        return total;
    }

    /// Makes the controller and the model anew: they are over if calls differ.
    void make_controllers() {
        model.reset();
        controller.reset();
        controller.emplace(world);
        model.emplace(world, 1);
    }
};

struct NamedCall {
    std::string name;
    std::function<void(Input&)> make;
};

/// Every collective function. Steps wait for those before, so two of them wait for all ranks.
std::vector<NamedCall> all_calls() {
    return {
        {"balance", [](Input& in) { balance(in.points, world); }},
        {"balance_as_in_paper", [](Input& in) { balance_as_in_paper(in.points, world); }},
        {"plan", [](Input& in) { plan(in.balanced, world); }},
        {"remap", [](Input& in) { remap(in.balanced.parts, in.ranks, world); }},
        {"transfer", [](Input& in) { transfer(in.lists, column(in.coordinates, 2), world); }},
        {"ghost_plan",
         [](Input& in) { ghost_plan(in.balanced.cuts, in.points, world, {.cutoff = 0.1}); }},
        {"fetch", [](Input& in) { fetch(in.near, column(in.coordinates, 2), world); }},
        {"accumulate",
         [](Input& in) {
             std::vector<double> sums(in.points.count);
             accumulate(in.near, column(in.of_ghosts), column(sums), world);
         }},
        {"reply", [](Input& in) { static_cast<void>(reply(in.near, in.of_ghosts, world)); }},
        {"verify",
         [](Input& in) { experimental::verify(in.near, in.points, world, {.sample = 5}); }},
        {"groups", [](Input& in) { groups(in.points, in.keys, world); }},
        {"fetch of groups",
         [](Input& in) { to_points(in.clusters, column(in.clusters.weights), world); }},
        {"group_sums",
         [](Input& in) {
             group_sums(in.clusters, std::vector<double>(in.points.count, 1.0), world);
         }},
        {"part_weights", [](Input& in) { part_weights(in.points, in.balanced, world); }},
        {"moved_fraction", [](Input& in) { moved_fraction(in.points, in.balanced, world); }},
        {"assign", [](Input& in) { assign(in.balanced.cuts, in.points, world); }},
        {"Controller::step",
         [](Input& in) {
             for (int k = 0; k < 3; ++k) in.controller->step({.load = 1});
         }},
        {"CostModel::step",
         [](Input& in) {
             const double count = 1;
             for (int k = 0; k < 3; ++k) in.model->step(1, {&count, 1});
         }},
        {"Controller", [](Input&) { Controller{world}; }},
        {"CostModel",
         [](Input&) {
             experimental::CostModel{world, 1};
         }},
        {"rrcb_balancer_create (Python: balance, assign)",
         [](Input&) {
             rrcb_balancer* made = nullptr;
             if (rrcb_balancer_create(world, &made) != RRCB_OK)
                 throw Error(ErrorCode::mpi, rrcb_last_error());
             rrcb_balancer_destroy(&made);
         }},
    };
}

/// One rank makes another call than all others.
void expect_difference(const NamedCall& others, const NamedCall& odd, int odd_rank, Input& in) {
    SCOPED_TRACE(odd.name + " on rank " + std::to_string(odd_rank) + ", else " + others.name);
    const std::string of_root = odd_rank == 0 ? odd.name : others.name;
    const std::string of_next = odd_rank == 0 ? others.name : odd.name;
    test::expect_same_error([&] { (rank() == odd_rank ? odd : others).make(in); },
                            "rank 0 calls " + of_root + ", rank 1 calls " + of_next +
                                "; every rank must make the same calls in the same order",
                            ErrorCode::mpi);
}

class DifferentCalls : public testing::Test {
  protected:
    DifferentCalls() { mpi::patience = std::chrono::milliseconds(5); }
    ~DifferentCalls() override { mpi::patience = before_; }

    std::chrono::milliseconds before_ = mpi::patience;
};

// Each pair of calls once; which of the two is the odd one depends on the number of ranks.
TEST_F(DifferentCalls, get_an_error_on_every_rank_that_names_them_and_the_next_call_is_right) {
    const std::vector<NamedCall> calls = all_calls();
    Input in;
    for (std::size_t i = 0; i < calls.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const bool turned = (i + j + static_cast<std::size_t>(num_ranks())) % 2 == 0;
            const NamedCall& others = calls[turned ? j : i];
            const NamedCall& odd = calls[turned ? i : j];
            in.make_controllers();
            expect_difference(others, odd, static_cast<int>(i % 2), in);
            ASSERT_FALSE(HasFatalFailure() || HasNonfatalFailure()) << others.name << odd.name;
            EXPECT_EQ(balance(in.points, world).parts, in.balanced.parts);
        }
}

TEST_F(DifferentCalls, end_the_controllers_that_were_made_before) {
    Input in;
    in.make_controllers();
    for (int k = 0; k < 3; ++k) in.controller->step({.load = 1});
    EXPECT_THROW(rank() == 1 ? (void)plan(in.balanced, world)
                             : (void)part_weights(in.points, in.balanced, world),
                 Error);
    const auto step = [&] { in.controller->step({.load = 1}); };
    test::expect_same_error(step, "rank 1 calls plan", ErrorCode::mpi);
    test::expect_same_error(step, "make another controller", ErrorCode::mpi);
    EXPECT_EQ(balance(in.points, world).parts, in.balanced.parts);
}

TEST_F(DifferentCalls, are_found_although_a_step_was_left_out_before) {
    Input in;
    in.make_controllers();
    test::expect_same_error(
        [&] {
            if (rank() != 1) in.controller->step({.load = 1});
            balance(in.points, world);
        },
        "rank 0 calls Controller::step, rank 1 calls balance", ErrorCode::mpi);
}

TEST_F(DifferentCalls, are_not_suspected_of_ranks_that_are_late) {
    Input in;
    for (int late = 0; late < num_ranks(); ++late) {
        std::this_thread::sleep_for(std::chrono::milliseconds(rank() == late ? 60 : 0));
        EXPECT_EQ(plan(in.balanced, world).import_parts, in.lists.import_parts);
        std::this_thread::sleep_for(std::chrono::milliseconds(rank() == late ? 60 : 0));
        EXPECT_EQ(balance(in.points, world).parts, in.balanced.parts);
        std::this_thread::sleep_for(std::chrono::milliseconds(rank() == late ? 60 : 0));
        EXPECT_EQ(assign(in.balanced.cuts, in.points, world), in.balanced.parts);
    }
}

TEST_F(DifferentCalls, give_a_c_program_the_code_and_the_text) {
    Input in;
    const rrcb_points points =
        rrcb_interleaved_points(RRCB_DOUBLE, 2, in.points.count, in.coordinates.data(), nullptr);
    std::vector<std::int32_t> parts(in.points.count);
    rrcb_balancer* balancer = nullptr;
    ASSERT_EQ(rrcb_balancer_create(world, &balancer), RRCB_OK);
    EXPECT_EQ(rrcb_balance(balancer, &points, parts.data()), RRCB_OK);
    const int code = rank() == 1 ? rrcb_plan(balancer, parts.size(), parts.data())
                                 : rrcb_balance(balancer, &points, parts.data());
    EXPECT_EQ(code, RRCB_MPI_ERROR);
    EXPECT_STREQ(rrcb_last_error(),
                 "rank 0 calls balance, rank 1 calls plan; every rank must make the same calls in "
                 "the same order");
    EXPECT_EQ(rrcb_balance(balancer, &points, parts.data()), RRCB_OK);
    EXPECT_EQ(parts, in.balanced.parts);
    rrcb_balancer_destroy(&balancer);
}

}  // namespace
}  // namespace rrcb
