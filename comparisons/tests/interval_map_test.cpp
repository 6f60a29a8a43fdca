// What rebalances cost over the interval between them, beside the prediction for linear growth.
#include "interval_map.hpp"

#include "rebalance_policies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace comparisons {
namespace {

constexpr LinearGrowth model{.cost = 3, .floor = 0.01, .growth = 0.0004};

/// Grows as the model says, in whatever unit of the load.
LoadHistory linear_history(int num_steps, double unit) {
    const auto load = [unit](int made, int step) {
        return rrcb::StepLoad{unit, unit * (1 + model.floor + model.growth * (step - made))};
    };
    return {"linear", num_steps, load, [unit](int) { return unit * model.cost; }};
}

TEST(PredictedOverhead, is_that_of_a_linear_history) {
    constexpr int num_steps = 2520;  // whole cycles of each of the intervals
    for (const double unit : {1.0, 2.5e-3}) {
        const LoadHistory history = linear_history(num_steps, unit);
        for (const int every : {1, 2, 5, 10, 63, 120, 1260, 2520}) {
            EXPECT_NEAR(overhead_of_interval(history, every), predicted_overhead(model, every),
                        1e-10)
                << every;
        }
        const LinearGrowth found = linear_growth(history, 40);
        EXPECT_NEAR(found.cost, model.cost, 1e-10);
        EXPECT_NEAR(found.floor, model.floor, 1e-12);
        EXPECT_NEAR(found.growth, model.growth, 1e-12);
    }
}

TEST(GrowthInACycle, is_that_over_the_interval_it_predicts) {
    const LinearGrowth same = growth_in_a_cycle(linear_history(2000, 1));
    EXPECT_NEAR(same.growth, model.growth, 1e-12);
    for (const double power : {0.5, 2.0}) {
        LoadHistory history = linear_history(2000, 1);
        const auto excess = [power](int age) { return 0.3 * std::pow(age / 500.0, power); };
        history.load = [excess](int made, int step) {
            return rrcb::StepLoad{1, 1 + excess(step - made)};
        };
        const LinearGrowth found = growth_in_a_cycle(history);
        const int every = predicted_interval(found, history.num_steps);
        EXPECT_NEAR(found.growth * every / excess(every), 1, 0.03) << power;
    }
}

TEST(PredictedInterval, is_the_least_of_all) {
    for (const double cost : {0.02, 0.1, 3.0, 70.0, 1e5}) {
        for (const double growth : {1e-9, 4e-4, 0.3}) {
            const LinearGrowth other{cost, 0.01, growth};
            constexpr int num_steps = 3000;
            double least = predicted_overhead(other, 1);
            for (int every = 2; every <= num_steps; ++every)
                least = std::min(least, predicted_overhead(other, every));
            EXPECT_EQ(predicted_overhead(other, predicted_interval(other, num_steps)), least);
        }
    }
    EXPECT_EQ(predicted_interval({3, 0.01, 0}, 700), 700);
    EXPECT_EQ(predicted_interval({3, 0.01, -1}, 700), 700);
}

TEST(PredictedOverhead, goes_with_the_square_root_of_the_cost) {
    const auto least = [](double cost) {
        const LinearGrowth other{cost, 0, 1e-7};
        return predicted_overhead(other, predicted_interval(other, 1'000'000));
    };
    EXPECT_NEAR(least(5) / least(100), std::sqrt(5.0 / 100), 1e-4);
}

TEST(OverheadOfNone, is_the_excess_load_alone) {
    const LoadHistory history = linear_history(101, 4);
    EXPECT_NEAR(overhead_of_none(history), 0.01 + 0.0004 * 50, 1e-12);
}

TEST(OverheadOfController, counts_the_rebalance_before_the_first_step) {
    LoadHistory history = linear_history(50, 1);
    history.load = [](int, int) { return rrcb::StepLoad{2, 2}; };
    EXPECT_NEAR(overhead_of_controller(history), 3.0 / 100, 1e-12);
}

TEST(MappedIntervals, are_spaced_evenly_up_to_the_steps) {
    EXPECT_EQ(mapped_intervals(25), (std::vector<int>{1, 2, 3, 5, 7, 10, 15, 20, 25}));
    EXPECT_EQ(mapped_intervals(10), (std::vector<int>{1, 2, 3, 5, 7, 10}));
    EXPECT_EQ(mapped_intervals(1), std::vector<int>{1});
}

MappedScene mapped_scene() {
    MappedScene scene{"pile, high", 4, linear_history(20, 1), {}};
    scene.methods.push_back({"rrcb", linear_history(20, 1), {0.5, 2}, 0.125, 0.0625});
    return scene;
}

TEST(MapRows, are_one_for_each_interval_and_the_controller) {
    const std::vector<Row> rows = map_rows(mapped_scene());
    const std::vector<int> intervals = mapped_intervals(20);
    ASSERT_EQ(rows.size(), 1 + intervals.size() + 1);
    EXPECT_EQ(rows[0].header(), "scene,ranks,method,every,overhead");
    EXPECT_EQ(rows[0].text().substr(0, 21), "\"pile, high\",4,none,,");
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        const std::string start = "\"pile, high\",4,rrcb," + std::to_string(intervals[i]) + ',';
        ASSERT_EQ(rows[1 + i].text().substr(0, start.size()), start);
        EXPECT_DOUBLE_EQ(std::stod(rows[1 + i].text().substr(start.size())),
                         overhead_of_interval(linear_history(20, 1), intervals[i]));
    }
    EXPECT_EQ(rows.back().text().substr(0, 25), "\"pile, high\",4,rrcb,auto,");
}

TEST(Optima, are_the_least_of_the_mapped_intervals) {
    const MappedScene scene = mapped_scene();
    const std::vector<Optimum> found = optima(scene);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].best_every, 20);
    EXPECT_EQ(found[0].overhead, overhead_of_interval(scene.methods[0].history, 20));
    EXPECT_NEAR(found[0].overhead - found[0].overhead95.low, 1.5 / 20, 1e-12);
    EXPECT_NEAR(found[0].overhead95.high - found[0].overhead, 3.0 / 20, 1e-12);
    const Row row = optimum_rows(scene).at(0);
    EXPECT_EQ(row.header(),
              "scene,ranks,method,best_every,overhead,predicted_every,predicted_overhead,"
              "auto_overhead,overhead_low,overhead_high,cost_ms,call_ms,cost_steps,floor,growth");
    EXPECT_EQ(row.columns()[10].second, "125");
    EXPECT_EQ(row.columns()[11].second, "62.5");
}

TEST(StepRows, end_with_what_the_overhead_is) {
    const MappedScene scene = mapped_scene();
    const std::vector<Row> rows = step_rows(scene);
    ASSERT_EQ(rows.size(), 3U * 20);
    EXPECT_EQ(rows[0].header(), "scene,ranks,method,every,step,imbalance,rebalanced,lost");
    const auto lost = [&](std::size_t row) {
        return std::stod(rows[row].columns().back().second) / 20;
    };
    EXPECT_NEAR(lost(19), overhead_of_none(scene.none), 1e-12);
    EXPECT_NEAR(lost(39), overhead_of_interval(scene.methods[0].history, 20), 1e-12);
    EXPECT_NEAR(lost(59), overhead_of_controller(scene.methods[0].history), 1e-12);
}

}  // namespace
}  // namespace comparisons
