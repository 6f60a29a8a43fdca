// The cost model on ranks: the same costs and weights on all, errors that reach all, one reduction
// with the controller's.
#include "ranks.hpp"
#include "same_error.hpp"

#include <rrcb/error.hpp>
#include <rrcb/experimental/cost.hpp>

namespace rrcb {
namespace {

using test::expect_same_error;

/// Points and cells of this rank: as many points on each, but more cells on higher ranks.
std::vector<double> columns_at(int step) {
    return {100, 10.0 + 20.0 * rank() + step % 7};
}

/// A point costs 2 ms, a cell 10 ms.
double seconds_at(int step) {
    const std::vector<double> columns = columns_at(step);
    return 0.002 * columns[0] + 0.01 * columns[1];
}

template <class Model>
void record(Model& model, int num_steps) {
    for (int step = 0; step < num_steps; ++step) model.step(seconds_at(step), columns_at(step));
}

TEST(CostModel, learns_costs_and_weighs_points_by_them) {
    experimental::CostModel model(MPI_COMM_WORLD, 2);
    EXPECT_FALSE(model.uses_costs());
    EXPECT_EQ(model.weights(std::vector<double>{1, 0.5, 1, 0.25}), (std::vector<double>{1, 1}));
    record(model, 30);
    if (num_ranks() == 1) {
        EXPECT_FALSE(model.uses_costs());
        EXPECT_EQ(model.report(), "points are counted: there is one rank only");
        return;
    }
    EXPECT_TRUE(model.uses_costs()) << model.report();
    EXPECT_NEAR(model.costs()[0], 0.002, 1e-5);
    EXPECT_NEAR(model.costs()[1], 0.01, 1e-5);
    for (const double cost : model.costs()) EXPECT_TRUE(test::same_on_all_ranks(cost));
    const std::vector<double> weights = model.weights(std::vector<double>{1, 0.5, 1, 0});
    EXPECT_NEAR(weights[0], 0.007, 1e-5);
    EXPECT_NEAR(weights[1], 0.002, 1e-5);
    EXPECT_TRUE(model.weights({}).empty());
    EXPECT_EQ(model.report().find("learned costs are used: they miss the seconds"), 0U);
}

TEST(CostModel, counts_what_takes_as_long_on_every_rank) {
    experimental::CostModel model(MPI_COMM_WORLD, 2);
    for (int step = 0; step < 30; ++step) model.step(1, columns_at(step));
    EXPECT_FALSE(model.uses_costs());
    EXPECT_EQ(model.report().find("points are counted: "), 0U);
}

TEST(CostModel, takes_steps_without_work_and_columns_without_cost) {
    experimental::CostModel model(MPI_COMM_WORLD, 3);
    for (int step = 0; step < 30; ++step) model.step(0, std::vector<double>{0, 0, 0});
    EXPECT_EQ(model.costs(), (std::vector<double>{0, 0, 0}));
    EXPECT_FALSE(model.uses_costs());
}

TEST(CostModel, steps_the_controller_by_the_same_reduction) {
    Controller alone(MPI_COMM_WORLD);
    Controller tied(MPI_COMM_WORLD);
    experimental::CostModel model(tied, 2);
    alone.rebalanced({.cost = 0.5});
    tied.rebalanced({.cost = 0.5});
    // As long as points are counted the controller gets what a step with a weight gives it.
    for (int step = 0; step < 10; ++step) {
        alone.step({.load = seconds_at(step), .weight = columns_at(step)[0]});
        model.step(seconds_at(step), columns_at(step));
        EXPECT_EQ(tied.due(), alone.due());
    }
}

TEST(CostModel, makes_the_controller_ask_once_costs_are_learned) {
    if (num_ranks() == 1) GTEST_SKIP() << "nothing is learned";
    Controller controller(MPI_COMM_WORLD);
    experimental::CostModel model(controller, 2);
    // Each rebalance so far has left the same imbalance, so none is due.
    int num_due = 0;
    for (int step = 0; step < 200; ++step) {
        if (step < 8) controller.rebalanced({.cost = 0.5});
        model.step(seconds_at(step), columns_at(step));
        if (!controller.due()) continue;
        if (++num_due == 1) {
            EXPECT_TRUE(model.uses_costs());
        }
        controller.rebalanced({.cost = 0.5});
    }
    EXPECT_GE(num_due, 1);
    EXPECT_LE(num_due, 8);
}

TEST(CostModel, refuses_numbers_of_one_rank_on_all) {
    const std::string last = "rank " + std::to_string(num_ranks() - 1);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {-1.0, std::nan(""), infinity, 1e101}) {
        experimental::CostModel seconds(MPI_COMM_WORLD, 1);
        seconds.step(is_last_rank() ? bad : 1, std::vector<double>{1});
        experimental::CostModel columns(MPI_COMM_WORLD, 2);
        columns.step(1, std::vector<double>{1, is_last_rank() ? bad : 1});
        for (experimental::CostModel* model : {&seconds, &columns})
            for (int call = 0; call < 2; ++call)
                expect_same_error(
                    [&] {
                        model->step(1, std::vector<double>{1, 1});
                    },
                    last + ": the load, the points or a column of a step are");
    }
    experimental::CostModel model(MPI_COMM_WORLD, 2);
    model.step(1, std::vector<double>(is_last_rank() ? 3 : 2, 1.0));
    expect_same_error(
        [&] {
            model.step(1, std::vector<double>{1, 1});
        },
        last + ": a step has no columns, or another number than the cost model; give as many");
}

TEST(CostModel, refuses_what_it_cannot_be_made_with) {
    for (const int bad : {-1, 0, 17})
        expect_same_error(
            [&] { experimental::CostModel(MPI_COMM_WORLD, is_last_rank() ? bad : 2); },
            "a cost model has 1 to 16 columns, not " + std::to_string(bad));
    if (num_ranks() > 1)
        expect_same_error([&] { experimental::CostModel(MPI_COMM_WORLD, is_last_rank() ? 3 : 2); },
                          "the number of columns differs between rank 0 and rank");
    expect_same_error([] { experimental::CostModel(MPI_COMM_NULL, 1); },
                      "MPI_COMM_NULL has no ranks");
    Controller controller(MPI_COMM_WORLD);
    experimental::CostModel model(controller, 2);
    expect_same_error([&] { experimental::CostModel(controller, 2); },
                      "the controller has a cost model already");
    Controller old(MPI_COMM_WORLD);
    old.step({.load = 1});
    expect_same_error([&] { experimental::CostModel(old, 2); },
                      "the controller has recorded steps");
    expect_same_error(
        [&] {
            model.weights(std::vector<double>{1, 1, 1});
        },
        "columns has 3 numbers; give a row for each point");
}

TEST(CostModel, may_outlive_the_communicator_and_be_moved) {
    MPI_Comm comm = MPI_COMM_NULL;
    MPI_Comm_dup(MPI_COMM_WORLD, &comm);
    std::optional<experimental::CostModel> first(std::in_place, comm, 2);
    MPI_Comm_free(&comm);
    record(*first, 5);
    experimental::CostModel second(std::move(*first));
    first.reset();
    record(second, 5);
    second = experimental::CostModel(MPI_COMM_WORLD, 2);
    record(second, 1);
}

TEST(CostModel, that_was_moved_from_throws) {
    experimental::CostModel old(MPI_COMM_WORLD, 2);
    const experimental::CostModel model(std::move(old));
    const std::vector<double> columns{1, 1};
    const char* text = "the cost model was moved from; use the one that it was moved to";
    expect_same_error([&] { old.step(1, columns); }, text);
    expect_same_error([&] { (void)old.weights(columns); }, text);
    expect_same_error([&] { (void)old.costs(); }, text);
    expect_same_error([&] { (void)old.uses_costs(); }, text);
    expect_same_error([&] { (void)old.report(); }, text);
}

// Ends after MPI has.
std::optional<experimental::CostModel> left_over;

TEST(CostModel, may_outlive_mpi) {
    left_over.emplace(MPI_COMM_WORLD, 2);
    record(*left_over, 2);
}

}  // namespace
}  // namespace rrcb
