#include "simulation_rounds.hpp"

#include <gtest/gtest.h>
#include <mpm/slope.hpp>

namespace comparisons {
namespace {

/// Steps of `step_s` and rebalances of `balance_s` on the critical path, a quarter of each network.
SimulationRun run(double step_s, double balance_s, double imbalance = 1.5) {
    SimulationRun run;
    run.num_points = 1000;
    run.wall_s = 10 * (step_s + balance_s);
    run.step_cost = {4 * step_s, 0.75 * step_s, 0.25 * step_s};
    run.balance_cost = {4 * balance_s, 0.75 * balance_s, 0.25 * balance_s};
    run.mean_imbalance = imbalance;
    run.moved_fraction = 0.25;
    run.rebalances = balance_s > 0 ? 8 : 0;
    return run;
}

/// Two methods beside none; noise of the rounds cancels in the pairs.
std::vector<SimulationRounds> three_rounds() {
    return {{"none", {run(8, 0), run(16, 0), run(12, 0)}},
            {"fast", {run(4, 1), run(8, 2), run(6, 1.5)}},
            {"slow", {run(4, 8, 1.1), run(8, 16, 1.3), run(6, 12, 1.2)}}};
}

TEST(SimulationRounds, take_the_median_of_every_column) {
    const SimulationSummary summary = summarize(three_rounds()[2]);
    EXPECT_EQ(summary.middle.method, "slow");
    EXPECT_EQ(summary.repeats, 3);
    EXPECT_DOUBLE_EQ(summary.middle.wall_s, 180);
    EXPECT_DOUBLE_EQ(summary.middle.mean_imbalance, 1.2);
    EXPECT_DOUBLE_EQ(summary.middle.step_cost.work_s, 24);
    EXPECT_DOUBLE_EQ(summary.middle.balance_cost.network_s, 3);
    EXPECT_DOUBLE_EQ(summary.critical_path_s.median, 18);
    EXPECT_FALSE(summary.critical_path_s.interval95);
}

TEST(SimulationRounds, compare_with_no_rebalancing_of_the_same_round) {
    const std::vector<SimulationSummary> summaries = summarize_all(three_rounds());
    EXPECT_DOUBLE_EQ(summaries[0].speed_up_critical_path->median, 1);
    EXPECT_DOUBLE_EQ(summaries[1].speed_up_critical_path->median, 8.0 / 5);
    EXPECT_DOUBLE_EQ(summaries[2].speed_up_critical_path->median, 8.0 / 12);
    for (const SimulationSummary& summary : summaries) {
        EXPECT_DOUBLE_EQ(summary.ideal_speed_up.value(), 2);  // 12 / 6 in the median
    }
    EXPECT_DOUBLE_EQ(summaries[0].gain_kept.value(), 0);
    EXPECT_DOUBLE_EQ(summaries[1].gain_kept.value(), (12 - 7.5) / (12 - 6));
    EXPECT_DOUBLE_EQ(summaries[2].gain_kept.value(), -1);
}

TEST(SimulationRounds, keep_no_gain_where_there_is_none) {
    const std::vector<SimulationRounds> methods = {{"none", {run(3, 0)}}, {"idle", {run(3, 1)}}};
    const std::vector<SimulationSummary> summaries = summarize_all(methods);
    EXPECT_DOUBLE_EQ(summaries[1].ideal_speed_up.value(), 1);
    EXPECT_FALSE(summaries[0].gain_kept);
    EXPECT_FALSE(summaries[1].gain_kept);
}

TEST(SimulationRounds, have_an_interval_from_six_on) {
    SimulationRounds rounds{"method", {}};
    for (const double step_s : {3, 6, 1, 4, 2, 5}) rounds.runs.push_back(run(step_s, 0, step_s));
    const SimulationSummary summary = summarize(rounds);
    ASSERT_TRUE(summary.wall_s.interval95);
    EXPECT_DOUBLE_EQ(summary.wall_s.interval95->low, 10);
    EXPECT_DOUBLE_EQ(summary.wall_s.interval95->high, 60);
    EXPECT_DOUBLE_EQ(summary.mean_imbalance.interval95->low, 1);
    EXPECT_DOUBLE_EQ(summary.mean_imbalance.interval95->high, 6);
}

TEST(SimulationRounds, that_agree_need_no_six_for_their_imbalance) {
    const SimulationSummary twice = summarize({"rrcb", {run(1, 1, 1.125), run(2, 1, 1.125)}});
    EXPECT_EQ(twice.mean_imbalance.interval95->low, 1.125);
    EXPECT_EQ(twice.mean_imbalance.interval95->high, 1.125);
    EXPECT_FALSE(summarize({"rrcb", {run(1, 1, 1.125)}}).mean_imbalance.interval95);
    SimulationRounds by_chance{"rrcb-sampled", {run(1, 1, 1.125), run(2, 1, 1.125)}};
    by_chance.runs[0].seed = 1;
    by_chance.runs[1].seed = 2;
    EXPECT_FALSE(summarize(by_chance).mean_imbalance.interval95);
}

SimulationRounds failing() {
    SimulationRun failed;
    failed.error = "no balance today";
    return {"broken", {run(1, 1), failed}};
}

TEST(SimulationRounds, that_fail_leave_the_others_alone) {
    std::vector<SimulationRounds> methods = three_rounds();
    methods.push_back(failing());
    const std::vector<SimulationSummary> summaries = summarize_all(methods);
    EXPECT_EQ(summaries[3].middle.error, "no balance today");
    EXPECT_FALSE(summaries[3].speed_up_critical_path);
    EXPECT_DOUBLE_EQ(summaries[1].ideal_speed_up.value(), 2);
    std::ranges::swap(methods.front(), methods.back());
    EXPECT_FALSE(summarize_all(methods)[1].speed_up_critical_path);
}

TEST(SimulationRounds, tell_their_noise_by_pairs) {
    const std::vector<SimulationRounds> rounds = three_rounds();
    const SimulationRounds again{"none", {run(10, 0), run(16, 0), run(9, 0)}};
    const std::vector<Noise> noise = noise_of("slope", rounds.front(), again);
    ASSERT_EQ(noise.size(), 2U);
    EXPECT_EQ(noise[0].what, "none");
    EXPECT_DOUBLE_EQ(noise[0].ratio.median, 1);
    EXPECT_TRUE(noise_of("slope", rounds.front(), failing()).empty());
    EXPECT_EQ(csv_of(noise, noise_row),
              "workload,what,ratio,low,high\n"
              "slope,none,1,,\nslope,none critical path,1,,\n");
}

/// Of every line of a CSV file.
std::vector<std::size_t> numbers_of_fields(const std::string& text) {
    std::vector<std::size_t> numbers;
    for (const std::string_view line : split(trim(text), '\n')) {
        if (!line.empty()) numbers.push_back(split(line, ',').size());
    }
    return numbers;
}

TEST(SimulationTable, rows_have_the_fields_of_their_header) {
    const SimulationPlan plan{.scene = mpm::slope_scene(22), .num_steps = 6};
    std::vector<SimulationRounds> methods = three_rounds();
    methods.push_back(failing());
    methods[1].runs[0].seed = 7;
    const std::string rounds = rounds_csv(plan, 4, methods);
    EXPECT_EQ(numbers_of_fields(rounds), std::vector<std::size_t>(12, 26));
    EXPECT_NE(rounds.find("\nfast,1,7,4,1000,6,1,50,"), std::string::npos);
    EXPECT_NE(rounds.find("\nfast,2,,4,1000,6,1,100,"), std::string::npos);

    const std::vector<SimulationSummary> all = summarize_all(methods);
    const std::string summaries = csv_of(
        all, [&](const SimulationSummary& summary) { return simulation_row(plan, 4, summary); });
    EXPECT_EQ(numbers_of_fields(summaries), std::vector<std::size_t>(5, 36));
    EXPECT_NE(summaries.find(",3,,,12,,,1,,,2,0,0,0.25,1.5,1.5,\n"), std::string::npos)
        << summaries;
}

TEST(SimulationTable, a_row_of_a_single_run_is_compared_with_nothing) {
    const SimulationPlan plan{.scene = mpm::slope_scene(22), .num_steps = 6};
    const SimulationRun single = run(4, 1);
    EXPECT_EQ(simulation_row(plan, 4, summarize({"rrcb", {single}})).text(),
              "rrcb,4,1000,6,1,50,0,0,1.5,1,,0,0,0,16,3,1,4,0.75,0.25,1,,,5,,,,,,,,8,0.25,,,");
}

}  // namespace
}  // namespace comparisons
