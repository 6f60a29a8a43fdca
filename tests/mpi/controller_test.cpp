// The controller on ranks: one decision for all, errors that reach all, an end that is free.
#include "../support/same_error.hpp"
#include "ranks.hpp"

#include <rrcb/controller.hpp>
#include <rrcb/error.hpp>
#include <rrcb/experimental/cost.hpp>

namespace rrcb {
namespace {

/// Rank 0 gains a hundredth of the mean at each step since the last rebalance, the others lose it;
/// in at most 100 steps.
double drifting_load(int steps_since) {
    const double others = num_ranks() - 1;
    if (others == 0) return 1;
    return 1 + 0.01 * steps_since * (rank() == 0 ? 1 : -1 / others);
}

/// Steps after which it says to rebalance, where it is heeded, with loads and costs in some unit.
std::vector<int> rebalances(int num_steps, double unit = 1) {
    Controller controller(MPI_COMM_WORLD);
    std::vector<int> steps;
    int last = 0;
    controller.rebalanced({.cost = 0.5 * unit});
    for (int step = 0; step < num_steps; ++step) {
        if (!controller.step({.load = drifting_load(step - last) * unit})) continue;
        steps.push_back(step);
        last = step + 1;
        controller.rebalanced({.cost = 0.5 * unit});
    }
    return steps;
}

TEST(Controller, says_the_same_on_every_rank_and_rebalances_what_grows) {
    const std::vector<int> steps = rebalances(200);
    for (const double unit : {0x1p1000, 0x1p-1000}) EXPECT_EQ(rebalances(200, unit), steps);
    ASSERT_TRUE(test::same_on_all_ranks(static_cast<double>(steps.size())));
    for (const int step : steps) EXPECT_TRUE(test::same_on_all_ranks(step));
    if (num_ranks() == 1) {
        EXPECT_TRUE(steps.empty());
        return;
    }
    // The mean cost (C + s t^2 / 2) / t is least at t = sqrt(2 C / s) = 10, and 6 for a first cost,
    // of which a third counts. The rule sees it by the 9 steps 0 ... 8, and is heeded two later.
    ASSERT_FALSE(steps.empty());
    EXPECT_EQ(steps.front(), 10);
    const double mean_cycle = 200.0 / static_cast<double>(steps.size());
    EXPECT_GE(mean_cycle, 9);
    EXPECT_LE(mean_cycle, 16);
}

TEST(Controller, returns_the_largest_number_of_the_step_before) {
    Controller controller(MPI_COMM_WORLD);
    experimental::CostModel model(controller, 1);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 6; ++step) {
        double number = 10 * step + rank();
        if (step == 4 && rank() == 0) number = std::nan("");
        model.step(1, std::array{1.0}, step == 3 ? nullptr : &number);
        if (step == 0 || step == 4) {
            EXPECT_EQ(number, -infinity);
        } else if (step != 3) {
            EXPECT_EQ(number, step == 5 ? infinity : 10 * (step - 1) + num_ranks() - 1);
        }
    }
}

TEST(Controller, returns_it_without_a_cost_model) {
    Controller controller(MPI_COMM_WORLD);
    double number = rank();
    controller.step({.load = 1, .weight = 1, .largest = &number});
    number = -5;
    controller.step({.load = 1, .largest = &number});
    EXPECT_EQ(number, num_ranks() - 1);
}

TEST(Controller, drops_what_it_decided_before_a_rebalance_it_did_not_ask_for) {
    Controller controller(MPI_COMM_WORLD);
    controller.rebalanced({.cost = 0.5});
    for (int step = 0; step <= 9; ++step)
        EXPECT_FALSE(controller.step({.load = drifting_load(step)}));
    controller.rebalanced({.cost = 0.5});
    for (int step = 10; step < 18; ++step)
        EXPECT_FALSE(controller.step({.load = drifting_load(step - 10)}));
}

TEST(Controller, repeats_what_is_not_heeded) {
    if (num_ranks() == 1) GTEST_SKIP() << "nothing is due";
    Controller controller(MPI_COMM_WORLD);
    controller.rebalanced({.cost = 0.5});
    std::vector<int> due;
    for (int step = 0; step < 21; ++step)
        if (controller.step({.load = drifting_load(step)})) due.push_back(step);
    EXPECT_EQ(due, (std::vector<int>{10, 13, 16, 19}));
}

TEST(Controller, returns_its_answer_until_the_next_step_or_rebalance) {
    Controller controller(MPI_COMM_WORLD);
    EXPECT_FALSE(controller.due());
    controller.rebalanced({.cost = 0.5});
    for (int step = 0; step < 20; ++step) {
        const bool is_due = controller.step({.load = drifting_load(step)});
        EXPECT_EQ(controller.due(), is_due) << step;
    }
    for (int step = 20; num_ranks() > 1 && !controller.due(); ++step)
        controller.step({.load = drifting_load(step)});
    controller.rebalanced({.cost = 0.5});
    EXPECT_FALSE(controller.due());
}

// Equal points that cost the same on average: a clock that jumps by half shows no imbalance.
TEST(Controller, takes_no_noise_of_a_clock_for_imbalance) {
    Controller controller(MPI_COMM_WORLD);
    controller.rebalanced({.cost = 1});
    for (int step = 0; step < 300; ++step) {
        const double load = (step + rank()) % 2 == 0 ? 0.5 : 1.5;
        EXPECT_FALSE(controller.step({.load = load, .weight = 1000})) << step;
    }
}

TEST(Controller, does_not_rebalance_above_the_least_imbalance) {
    Controller controller(MPI_COMM_WORLD);
    Report report;
    report.details.least_imbalance = 3;  // loads stay below it
    controller.rebalanced({.cost = 0.5, .report = &report});
    for (int step = 0; step < 90; ++step)
        EXPECT_FALSE(controller.step({.load = drifting_load(step)}));
}

/// Every rank gets the same error, at this call and each later one.
void expect_error(Controller& controller, const std::string& text) {
    for (int call = 0; call < 2; ++call) {
        test::expect_same_error([&] { controller.step({.load = 1}); }, text);
    }
}

TEST(Controller, refuses_bad_loads_and_costs_of_one_rank_on_all) {
    const std::string last = "rank " + std::to_string(num_ranks() - 1);
    const std::string fix = " negative, NaN or infinite; give a finite number of at least 0";
    for (const double bad : {std::nan(""), -1.0, std::numeric_limits<double>::infinity()}) {
        Controller loads(MPI_COMM_WORLD);
        EXPECT_FALSE(loads.step({.load = is_last_rank() ? bad : 1}));
        expect_error(loads, last + ": the load, the points or a column of a step are" + fix);

        Controller points(MPI_COMM_WORLD);
        EXPECT_FALSE(points.step({.load = 1, .weight = is_last_rank() ? bad : 1}));
        expect_error(points, last + ": the load, the points or a column of a step are" + fix);

        Controller costs(MPI_COMM_WORLD);
        EXPECT_FALSE(costs.step({.load = 1}));
        costs.rebalanced({.cost = is_last_rank() ? bad : 1});
        EXPECT_FALSE(costs.step({.load = 1}));
        expect_error(costs, last + ": the cost of a rebalance is" + fix);
    }
}

TEST(Controller, names_the_lowest_of_the_ranks_with_bad_input) {
    const int lowest = std::min(1, num_ranks() - 1);
    Controller controller(MPI_COMM_WORLD);
    EXPECT_FALSE(controller.step({.load = rank() < lowest ? 1. : -1.}));
    expect_error(controller, "rank " + std::to_string(lowest) +
                                 ": the load, the points or a column of a step are negative, NaN "
                                 "or infinite; give a finite number of at least 0");
}

TEST(Controller, reports_ranks_that_have_not_rebalanced) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    Controller rebalances(MPI_COMM_WORLD);
    if (is_last_rank()) rebalances.rebalanced({.cost = 1});
    EXPECT_FALSE(rebalances.step({.load = 1}));
    expect_error(rebalances,
                 "rebalanced() was called 0 times on one rank and 1 times on another; call it on "
                 "every rank after each rebalance");
}

TEST(Controller, works_beside_another_and_after_its_communicator) {
    MPI_Comm comm = MPI_COMM_NULL;
    MPI_Comm_dup(MPI_COMM_WORLD, &comm);
    Controller one(comm);
    Controller other(comm);
    MPI_Comm_free(&comm);
    one.rebalanced({.cost = 0.5});
    other.rebalanced({.cost = 1e6});
    bool is_any_due = false;
    for (int step = 0; step < 60; ++step) {
        is_any_due = one.step({.load = drifting_load(step)}) || is_any_due;
        EXPECT_FALSE(other.step({.load = drifting_load(step)}));
    }
    EXPECT_EQ(is_any_due, num_ranks() > 1);
}

// Points of other weights cost other times, so a number of points smooths the imbalance away.
TEST(Controller, takes_no_number_of_points_for_a_sum_of_weights) {
    if (num_ranks() == 1) GTEST_SKIP() << "nothing is due";
    Report report;
    report.details.num_points = 100 * num_ranks();
    report.details.total_weight = 250.0 * num_ranks();
    Controller counting(MPI_COMM_WORLD);
    Controller plain(MPI_COMM_WORLD);
    counting.rebalanced({.cost = 0.5, .report = &report});
    plain.rebalanced({.cost = 0.5, .report = &report});
    for (int step = 0; step < 21; ++step)
        EXPECT_EQ(counting.step({.load = drifting_load(step), .weight = 100}),
                  plain.step({.load = drifting_load(step)}))
            << step;
}

TEST(Controller, that_was_moved_from_throws) {
    Controller old(MPI_COMM_WORLD);
    Controller controller(std::move(old));
    const std::string text = "the controller was moved from; use the one that it was moved to";
    const Report report;
    const std::vector<std::function<void()>> calls = {
        [&] { old.step({.load = 1}); },
        [&] { old.step({.load = 1, .weight = 1}); },
        [&] { (void)old.due(); },
        [&] { old.rebalanced({.cost = 1}); },
        [&] { old.rebalanced({.cost = 1, .report = &report}); },
        [&] { experimental::CostModel model(old, 2); },
    };
    for (const auto& call : calls) {
        test::expect_same_error([&] { call(); }, text);
    }
    old = std::move(controller);
    EXPECT_FALSE(old.step({.load = 1}));
}

TEST(Controller, may_be_forgotten_until_after_the_end_of_mpi) {
    static std::optional<Controller> forgotten;
    forgotten.emplace(MPI_COMM_WORLD);
    forgotten->step({.load = 1});  // its reduction is under way when MPI ends
}

}  // namespace
}  // namespace rrcb
