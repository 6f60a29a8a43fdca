#include "parallel/communicator_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "scene_choice_mpi.hpp"
#include "scene_mpi.hpp"
#include "simulation_mpi.hpp"

#include <gtest/gtest.h>

namespace comparisons {
namespace {

std::vector<SimulationRounds> quick_scene(const std::string& methods, int repeats,
                                          Cost cost = Cost::count, std::vector<int> every = {2}) {
    Arguments arguments;
    arguments.quick = true;
    arguments.steps = 4;
    arguments.every = std::move(every);
    arguments.repeats = repeats;
    arguments.methods = read_methods(methods);
    arguments.cost = cost;
    const ResultsFolder folder(
        testing::TempDir() + "rrcb_scene_rounds.np" + std::to_string(mpm::size_of(MPI_COMM_WORLD)),
        MPI_COMM_WORLD);
    int visits = 0;
    const auto visit = [&](std::span<const Workload> snapshots) {
        ++visits;
        EXPECT_EQ(snapshots.size(), 3U);
    };
    std::vector<SimulationRounds> runs = run_scene(arguments, folder, visit, MPI_COMM_WORLD);
    EXPECT_EQ(visits, 1);
    return runs;
}

TEST(SceneRounds, take_another_seed_each_and_keep_the_first_history) {
    const std::vector<SimulationRounds> methods =
        quick_scene("zoltan-rcb,zoltan-rib,rrcb-sampled[mesh=2]", 3);
    ASSERT_EQ(methods.size(), 4U);
    EXPECT_EQ(methods[0].method, "none");
    EXPECT_EQ(methods[2].method, "rrcb-sampled[mesh=2]");
    EXPECT_EQ(methods[3].method, "zoltan-rcb again");
    EXPECT_EQ(methods[3].runs[2].mean_imbalance, methods[1].runs[2].mean_imbalance);
    for (const SimulationRounds& rounds : methods) {
        ASSERT_EQ(rounds.runs.size(), 3U) << rounds.method;
        for (std::size_t round = 0; round < 3; ++round) {
            const SimulationRun& run = rounds.runs[round];
            EXPECT_EQ(run.error, "") << rounds.method;
            EXPECT_EQ(run.history.size(), round == 0 ? 4U : 0U) << rounds.method;
            EXPECT_EQ(run.seed.value_or(0), rounds.method.starts_with("rrcb") ? round + 1 : 0);
        }
    }
    const auto seed_three = make_balancer(read_method("rrcb-sampled[mesh=2,seed=3]"));
    const SimulationPlan plan{
        .scene = choose_scene("slope", true, MPI_COMM_WORLD), .num_steps = 4, .every = 2};
    TimedSimulation alone(plan, without_weights(seed_three), {}, MPI_COMM_WORLD);
    alone.advance(4);
    EXPECT_EQ(methods[2].runs[2].mean_imbalance, alone.result().mean_imbalance);
}

TEST(SceneRounds, have_all_intervals) {
    const std::vector<SimulationRounds> methods =
        quick_scene("zoltan-rcb[reuse,lock],rrcb-arrays[reuse]", 1, Cost::count, {1, 3, 0});
    ASSERT_EQ(methods.size(), 8U);
    EXPECT_EQ(methods[2].method, "rrcb-arrays[reuse] every 1");
    EXPECT_EQ(methods[6].method, "rrcb-arrays[reuse] every auto");
    for (const int i : {1, 2}) EXPECT_EQ(methods[i].runs.front().rebalances, 4);
    for (const int i : {3, 4}) EXPECT_EQ(methods[i].runs.front().rebalances, 2);
    EXPECT_EQ(methods[3].runs.front().decide_s, 0);
    EXPECT_GT(methods[6].runs.front().decide_s, 0);
}

TEST(SceneRounds, with_learned_costs_are_compared_with_counting) {
    const std::vector<SimulationRounds> methods = quick_scene("zoltan-rcb", 1, Cost::learned);
    ASSERT_EQ(methods.size(), 6U);
    EXPECT_EQ(methods[2].method, "count");
    EXPECT_EQ(methods[3].method, "learned");
    EXPECT_EQ(methods[4].method, "known");
    for (const SimulationRounds& rounds : methods) {
        ASSERT_EQ(rounds.runs.front().error, "") << rounds.method;
        const std::vector<LoadRecord>& history = rounds.runs.front().history;
        ASSERT_EQ(history.size(), 4U) << rounds.method;
        const std::vector<double> costs = unit_costs("slope");
        for (const LoadRecord& record : history)
            for (std::size_t part = 0; part < record.points.size(); ++part) {
                double work = 0;
                for (std::size_t j = 0; j < costs.size(); ++j)
                    work += costs[j] * record.columns[j][part];
                EXPECT_DOUBLE_EQ(record.columns[0][part], record.points[part]) << rounds.method;
                EXPECT_DOUBLE_EQ(record.columns[4][part], work) << rounds.method;
            }
    }
}

TEST(SceneRounds, repeat_the_first_one_and_keep_the_least_seconds) {
    const mpm::Scene scene = choose_scene("slope", true, MPI_COMM_WORLD);
    const SimulationPlan plan{
        .scene = scene, .num_steps = 40, .every = 0, .unit_costs = unit_costs("slope")};
    // The controller decides by seconds, so that only a repeated run rebalances in the same steps.
    std::vector<SimulationRun> rounds;
    for (int round = 0; round < 3; ++round) {
        TimedSimulation simulation(plan, without_weights(make_balancer(read_method("rrcb"))), {},
                                   MPI_COMM_WORLD, Cost::count,
                                   round == 0 ? nullptr : &rounds.back());
        simulation.advance(plan.num_steps);
        rounds.push_back(simulation.result());
        ASSERT_EQ(rounds.back().error, "");
    }
    for (std::size_t round = 1; round < rounds.size(); ++round) {
        const SimulationRun& before = rounds[round - 1];
        const SimulationRun& run = rounds[round];
        EXPECT_EQ(run.counted.all, before.counted.all);
        EXPECT_EQ(run.counted.path, before.counted.path);
        EXPECT_EQ(run.moved_m, before.moved_m);
        EXPECT_EQ(run.rebalances, before.rebalances);
        EXPECT_LE(run.least_s.path, before.least_s.path);
        ASSERT_EQ(run.work_s.size(), before.work_s.size());
        for (std::size_t step = 0; step < run.work_s.size(); ++step)
            EXPECT_LE(run.work_s[step], before.work_s[step]) << step;
    }
}

}  // namespace
}  // namespace comparisons
