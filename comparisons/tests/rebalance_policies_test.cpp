// Costs of rebalancing: the optimum by trying all choices, and the controller's regret.
#include "rebalance_policies.hpp"

#include "counter_random.hpp"
#include "generated_histories.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

namespace comparisons {
namespace {

/// Loads and costs at random, whenever the parts are made.
LoadHistory random_history(std::uint64_t seed, int num_steps) {
    const auto load = [seed](int made, int step) {
        const auto counter = static_cast<std::uint64_t>(1000 * made + step);
        return rrcb::StepLoad{1, CounterRandom(seed, counter).uniform(1, 3)};
    };
    const auto cost = [seed](int step) {
        return CounterRandom(seed + 100, static_cast<std::uint64_t>(step)).uniform(0, 2);
    };
    return {"random", num_steps, load, cost};
}

/// Of the steps chosen by the bits of a number, bit k: before step k + 1.
double cost_of_choice(const LoadHistory& history, unsigned choice) {
    double total = 0;
    int made = 0;
    for (int step = 0; step < history.num_steps; ++step) {
        if (step > 0 && (choice >> (step - 1) & 1U) != 0) total += history.cost(made = step);
        total += history.load(made, step).heaviest;
    }
    return total;
}

TEST(Optimum, is_the_least_of_all_choices) {
    constexpr int num_steps = 10;
    for (const unsigned seed : {1U, 2U, 3U}) {
        const LoadHistory history = random_history(seed, num_steps);
        double least = std::numeric_limits<double>::infinity();
        for (unsigned choice = 0; choice < 1U << (num_steps - 1); ++choice) {
            least = std::min(least, cost_of_choice(history, choice));
        }
        EXPECT_NEAR(optimum(history), least, 1e-12);
    }
}

TEST(Interval, rebalances_after_each_so_many_steps) {
    const LoadHistory history = random_history(4, 10);
    EXPECT_NEAR(cost_of_interval(history, 1), cost_of_choice(history, 0b111111111), 1e-12);
    EXPECT_NEAR(cost_of_interval(history, 3), cost_of_choice(history, 0b100100100), 1e-12);
    EXPECT_NEAR(cost_of_interval(history, 10), cost_of_choice(history, 0), 1e-12);
    double least = std::numeric_limits<double>::infinity();
    for (int interval = 1; interval <= 10; ++interval) {
        least = std::min(least, cost_of_interval(history, interval));
    }
    EXPECT_EQ(cost_of_best_interval(history), least);
}

/// Load 3 in steps 2, 3, ... of parts, 1 before.
LoadHistory two_good_steps(int num_steps) {
    const auto load = [](int made, int step) {
        return rrcb::StepLoad{1, step - made < 2 ? 1.0 : 3.0};
    };
    return {"two good steps", num_steps, load, [](int) { return 0.5; }};
}

double cost_of(const LoadHistory& history, const std::string& name) {
    for (const NamedPolicy& policy : policies()) {
        if (policy.name == name) return cost_of(history, *policy.make());
    }
    throw std::invalid_argument(name);
}

TEST(Policies, decide_as_their_names_say) {
    const LoadHistory history = two_good_steps(12);
    // 2 good steps, 1 that shows it, and a rebalance: four times 5, but no rebalance at the end.
    EXPECT_EQ(cost_of(history, "imbalance 1.1"), 4 * 5 + 3 * 0.5);
    EXPECT_EQ(cost_of(history, "plain criterion"), 4 * 5 + 3 * 0.5);
    EXPECT_EQ(cost_of(history, "never"), 2 + 10 * 3);
    // Three that show it: 2 + 3 * 3 before, 2 + 5 * 3 after the only rebalance.
    EXPECT_EQ(cost_of(history, "imbalance 1.35 for 3 steps; 100 of rest"), 11 + 0.5 + 17);
    EXPECT_EQ(optimum(history), 12 + 5 * 0.5);
}

TEST(Controller, comes_close_to_the_optimum_whatever_the_loads_do) {
    // What comes and goes, or jumps at once, cannot be foreseen.
    const std::set<std::string> unforeseen = {"jumps", "oscillation", "all at once"};
    double sum = 0;
    int count = 0;
    for (const unsigned seed : {1U, 2U}) {
        for (const LoadHistory& history : generated_histories(seed)) {
            const double regret = cost_of(history, "controller") / optimum(history) - 1;
            const std::string kind = history.name.substr(0, history.name.rfind(' '));
            EXPECT_LE(regret, unforeseen.contains(kind) ? 0.10 : 0.05) << history.name;
            EXPECT_GE(regret, -1e-12) << history.name;
            sum += regret;
            ++count;
        }
    }
    EXPECT_EQ(count, 20);
    EXPECT_LE(sum / count, 0.03);
}

}  // namespace
}  // namespace comparisons
