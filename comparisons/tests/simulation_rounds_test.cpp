#include "scene_mpi.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace comparisons {
namespace {

/// Returns a run whose steps take `step_s` on the critical path, a quarter of it in the network.
/// All other columns are the same in every run.
SimulationRun run_of(double step_s) {
    SimulationRun run;
    run.num_points = 1000;
    run.wall_s = 50;
    run.step_cost = {4 * step_s, 0.75 * step_s, 0, 0.25 * step_s};
    run.counted = {10 * step_s, 3 * step_s};
    run.balance_cost = {2.5, 0.5, 0.25, 0.125};
    run.mean_imbalance = 1.5;
    run.moved_fraction = 0.25;
    run.rebalances = 8;
    return run;
}

std::vector<SimulationRounds> two_methods() {
    SimulationRun failed;
    failed.error = "no balance today";
    std::vector<SimulationRounds> methods = {{"fast", {run_of(8), run_of(16)}},
                                             {"broken", {run_of(1), failed}}};
    methods[0].runs[0].seed = 7;
    methods[0].every = 3;
    return methods;
}

TEST(SimulationRounds, have_a_row_for_each_run) {
    SimulationPlan plan{.scene = {}, .num_steps = 6};
    plan.scene.name = "slope";
    EXPECT_EQ(
        rounds_csv(plan, 4, two_methods()),
        "method,round,seed,ranks,points,steps,every,scene,wall_s,balance_s,decide_s,step_s,"
        "mean_imbalance,worst_imbalance,front_x_m,moved_m,mass_kg,path_points,"
        "step_work_s,step_path_s,step_root_s,step_network_s,step_messages,step_bytes,"
        "balance_work_s,balance_path_s,balance_root_s,balance_network_s,balance_messages,"
        "balance_bytes,decide_work_s,decide_path_s,decide_root_s,decide_network_s,"
        "decide_messages,decide_bytes,counted,counted_path,counted_at_rest,counted_at_rest_path,"
        "least_s,least_s_path,least_at_rest_s,least_at_rest_s_path,critical_path_s,rebalances,"
        "moved_fraction,error\n"
        "fast,1,7,4,1000,6,3,slope,50,0,0,0,1.5,1,,0,0,0,32,6,0,2,0,0,"
        "2.5,0.5,0.25,0.125,0,0,0,0,0,0,0,0,80,24,0,0,0,0,0,0,8.625,8,0.25,\n"
        "fast,2,,4,1000,6,3,slope,50,0,0,0,1.5,1,,0,0,0,64,12,0,4,0,0,"
        "2.5,0.5,0.25,0.125,0,0,0,0,0,0,0,0,160,48,0,0,0,0,0,0,16.625,8,0.25,\n"
        "broken,1,,4,1000,6,auto,slope,50,0,0,0,1.5,1,,0,0,0,4,0.75,0,0.25,0,0,"
        "2.5,0.5,0.25,0.125,0,0,0,0,0,0,0,0,10,3,0,0,0,0,0,0,1.625,8,0.25,\n"
        "broken,2,,4,0,6,auto,slope,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,no balance today\n");
}

TEST(SimulationRounds, on_rank_0_alone_have_one_rank) {
    const std::vector<SimulationRounds> serial = {
        {"serial", {run_of(8)}, {}, Cost::count, 0, true}};
    const std::string text = rounds_csv({.scene = {}, .num_steps = 6}, 4, serial);
    EXPECT_NE(text.find("\nserial,1,,1,1000,6,"), std::string::npos) << text;
}

TEST(SimulationRounds, print_their_paths_and_why_one_failed) {
    std::ostringstream out;
    print_round(out, {2, 6, 30.2}, two_methods());
    EXPECT_EQ(
        out.str(),
        "broken failed: no balance today\n"
        "Round 2 of 6: with a core for every rank a simulation takes 16.625 to 16.625 s; about "
        "60 s left\n");
}

}  // namespace
}  // namespace comparisons
