// When a rebalance is due: series of loads whose answer is worked out by hand, and noise.
#include "controller/rebalance_rule.hpp"

#include "../support/common.hpp"
#include "controller/point_cost.hpp"

namespace rrcb {
namespace {

TEST(LatestSteps, takes_the_least_of_three_blocks) {
    LatestSteps steps;
    for (int i = 1; i <= 12; ++i) steps.add({2.0 * i, 2});
    EXPECT_EQ(steps.lasting(0), 10);   // 10, 11, 12
    EXPECT_EQ(steps.lasting(1), 7.5);  // 7.5, 9.5, 11.5
    EXPECT_EQ(steps.lasting(2), 2.5);  // 2.5, 6.5, 10.5
    EXPECT_TRUE(steps.has(2));
    EXPECT_FALSE(steps.has(3));
    EXPECT_EQ(steps.lasting(), 10);
    EXPECT_EQ(steps.block(2).work, 8);
}

TEST(LatestSteps, sees_every_fifth_step_and_no_single_one) {
    LatestSteps fifth;
    for (int i = 0; i < 96; ++i) fifth.add({i % 5 == 0 ? 5.0 : 0.0, 1});
    EXPECT_EQ(fifth.lasting(0), 0);
    EXPECT_GE(fifth.lasting(), 0.75);  // blocks of 16 or 32 steps hold their share or one less
    LatestSteps stall;
    for (int i = 0; i < 96; ++i) {
        stall.add({i == 50 ? 1000.0 : 0.0, 1});
        EXPECT_EQ(stall.lasting(), 0) << i;
    }
}

TEST(Cycle, gains_until_it_is_as_bad) {
    Cycle cycle;
    for (int i = 0; i < 4; ++i) cycle.add({2.0 * i, 2});  // mean excess 0, 0.5, 1.5 of 1, 2, 4
    EXPECT_EQ(cycle.gain(3, 1), 3);
    EXPECT_EQ(cycle.gain(3, 3), 5);
    EXPECT_EQ(cycle.gain(3, 100), 6);
    EXPECT_EQ(cycle.gain(1, 100), 1);
    cycle.add({8, 2});  // all five: 2
    EXPECT_EQ(cycle.gain(4, 100), 10);
    EXPECT_EQ(cycle.least_excess(), 1.5);
}

TEST(Cycle, averages_with_earlier_ones_beyond_its_end) {
    Cycle long_one;
    for (int i = 0; i < 4; ++i) long_one.add({0, 1});
    Cycle average;
    average.remember(long_one, 0);
    Cycle short_one;
    for (int i = 0; i < 2; ++i) short_one.add({3, 1});
    average.remember(short_one, 6);
    EXPECT_EQ(average.first(1).excess(), 2);         // 0 twice by half, 3 twice
    EXPECT_EQ(average.first(2).excess(), 18.0 / 6);  // 0 four times by half, 3 and 6 twice
    EXPECT_EQ(average.gain(5, 2), 6);
    EXPECT_EQ(average.gain(5, 4), 8);
}

TEST(PointCost, averages_the_cost_of_a_point) {
    PointCost cost;
    EXPECT_EQ(cost.smoothed(3, 0), 3);
    PointCost even;
    double load = 0;
    for (int i = 0; i < 1000; ++i) load = even.smoothed(i % 2 == 0 ? 1 : 3, 10);
    EXPECT_NEAR(load, 2, 0.01);
    EXPECT_NEAR(even.smoothed(2, 20), 4, 0.05);
}

/// Returns the rule after rebalances that cost the same.
RebalanceRule after_rebalance(double cost, double least_imbalance = 1, int number = 2) {
    RebalanceRule rule;
    for (int k = 0; k < number; ++k) rule.rebalanced(cost, least_imbalance);
    return rule;
}

/// Number of steps (from 1) after which a rebalance is due, of at most 2000; 0 if none is.
int first_due(RebalanceRule& rule, const std::function<double(int step)>& excess, double mean = 1) {
    for (int step = 0; step < 2000; ++step) {
        rule.add({mean, mean * (1 + excess(step))});
        if (rule.is_due()) return step + 1;
    }
    return 0;
}

TEST(RebalanceRule, leaves_equal_loads_and_their_rounding) {
    for (const double cost : {0.0, 1e-9, 1.0}) {
        RebalanceRule rule = after_rebalance(cost);
        EXPECT_EQ(first_due(rule, [](int step) { return step % 3 == 0 ? 0 : 4e-16; }), 0);
    }
    RebalanceRule unknown;
    EXPECT_EQ(first_due(unknown, [](int) { return 0; }), 0);
    RebalanceRule idle;
    EXPECT_EQ(first_due(
                  idle, [](int) { return 1; }, 0),
              0);
}

TEST(RebalanceRule, leaves_an_imbalance_that_a_rebalance_does_not_remove) {
    for (const double excess : {0.1, 3.0}) {
        RebalanceRule rule = after_rebalance(0.5);
        EXPECT_EQ(first_due(rule, [&](int) { return excess; }), 0) << excess;
    }
}

// The waste of s t a step is least at t = sqrt(2 C / s), where t u(t) - sum u = C: 100 and 10. The
// least of three blocks that make up a quarter of t is behind by a fifth of t or, as blocks fill,
// by more. A third too late costs a twentieth of the waste.
TEST(RebalanceRule, rebalances_linear_growth_near_the_best_interval) {
    const auto growth = [](int step) { return 0.01 * step; };
    RebalanceRule rare = after_rebalance(50);
    const int steps = first_due(rare, growth);
    EXPECT_GE(steps, 100);
    EXPECT_LE(steps, 140);
    RebalanceRule frequent = after_rebalance(0.5);
    EXPECT_NEAR(first_due(frequent, growth), 12, 2);
    for (const double unit : {1e-300, 0.001, 1e290}) {
        RebalanceRule rule = after_rebalance(50 * unit);
        EXPECT_EQ(first_due(rule, growth, unit), steps) << unit;
    }
}

TEST(RebalanceRule, sees_growth_in_every_kth_step) {
    for (const int k : {2, 3, 4, 5}) {
        RebalanceRule rule = after_rebalance(50);
        const int steps =
            first_due(rule, [&](int step) { return step % k == 0 ? k * 0.01 * step : 0; });
        EXPECT_GE(steps, 95) << k;
        EXPECT_LE(steps, 155) << k;
    }
}

// Fifty even steps, then 0.5. Three steps let expect twelve: 8 * 0.5 > 3.9. For a cost of 15,
// twelve steps in blocks of four let expect 32: 32 * 0.5 > 15; the blocks are full after the 64th
// step.
TEST(RebalanceRule, rebalances_a_jump_once_it_has_lasted_a_quarter_of_what_it_takes) {
    const auto jump = [](int step) { return step < 50 ? 0 : 0.5; };
    RebalanceRule cheap = after_rebalance(3.9);
    EXPECT_EQ(first_due(cheap, jump), 53);
    RebalanceRule costly = after_rebalance(15);
    EXPECT_EQ(first_due(costly, jump), 64);
}

// Of three blocks a stall raises one.
TEST(RebalanceRule, ignores_a_stall) {
    RebalanceRule rule = after_rebalance(0.5);
    EXPECT_EQ(first_due(rule, [](int step) { return step == 50 ? 50.0 : 0.0; }), 0);
}

// Swings from 0 to 2 in 40 steps, of mean 1. Above 1.5 it stays for 13 steps, so that 4 * 13 steps
// gain 0.5 each at most: less than 40.
TEST(RebalanceRule, does_not_chase_swings) {
    const auto swing = [](int step) { return 1 - std::cos(step * 3.14159265358979 / 20); };
    RebalanceRule rule = after_rebalance(40);
    const int steps = first_due(rule, swing);
    EXPECT_TRUE(steps == 0 || steps > 300) << steps;  // 8 * 40 of waste, and one is tried
}

TEST(RebalanceRule, expects_no_gain_below_the_least_imbalance) {
    RebalanceRule rule = after_rebalance(0.5, 4);
    EXPECT_EQ(first_due(rule, [](int step) { return step < 50 ? 0 : 2.9; }), 0);
    RebalanceRule above = after_rebalance(0.5, 4);
    EXPECT_EQ(first_due(above, [](int step) { return step < 50 ? 0 : 3.1; }), 53);
}

// A rebalance that nobody has made yet is taken for a step, and to leave nothing: 12 * 0.1 > 1.
TEST(RebalanceRule, takes_the_first_rebalance_for_a_step) {
    RebalanceRule rule;
    EXPECT_EQ(first_due(rule, [](int) { return 0.1; }), 3);
    RebalanceRule small;
    EXPECT_EQ(first_due(small, [](int) { return 0.05; }), 6);
}

/// After a cycle of so many steps of one excess, then three of another.
RebalanceRule after_cycle(double cost, int steps, double excess, double at_end) {
    RebalanceRule rule = after_rebalance(cost);
    for (int step = 0; step < steps; ++step) rule.add({1, 1 + excess});
    for (int step = 0; step < 3; ++step) rule.add({1, 1 + at_end});
    rule.rebalanced(cost, 1);
    return rule;
}

// A jump in the first steps would never be seen by its own cycle. The one before was even for 64
// steps: 8 * 0.5 > 3.
TEST(RebalanceRule, judges_an_early_jump_by_earlier_cycles) {
    RebalanceRule rule = after_cycle(3, 64, 0, 1);
    EXPECT_EQ(first_due(rule, [](int step) { return step < 2 ? 0 : 0.5; }), 5);
}

// After the last rebalance the excess was 0.5 at once, so it is left, also above the new start.
TEST(RebalanceRule, learns_that_a_rebalance_did_not_help) {
    RebalanceRule rule = after_cycle(3, 64, 0.5, 0.5);
    EXPECT_EQ(first_due(rule, [](int) { return 0.5; }), 0);
    rule.expect_less();
    EXPECT_EQ(first_due(rule, [](int) { return 0.5; }), 1);
}

// The first four steps were even, which no longer horizon repeats. What has lasted for 48 steps has
// cost 8 * 3; blocks of 16 are full by the 64th step.
TEST(RebalanceRule, tries_a_rebalance_after_much_waste) {
    const auto jump = [](int step) { return step < 4 ? 0 : 0.51; };
    RebalanceRule rule = after_rebalance(3);
    const int steps = first_due(rule, jump);
    EXPECT_GE(steps, 4 + 48);
    EXPECT_LE(steps, 4 + 96);
}

// Costs of 1, 100 and 1: the outlier counts as twice the median.
TEST(RebalanceRule, does_not_take_one_costly_rebalance_for_the_rule) {
    const auto growth = [](int step) { return 0.01 * step; };
    RebalanceRule rule = after_rebalance(1);
    const int usual = first_due(rule, growth);
    rule.rebalanced(1, 1);
    first_due(rule, growth);
    rule.rebalanced(100, 1);
    EXPECT_LE(first_due(rule, growth), 1.8 * usual);
}

/// Returns the steps until a rebalance is due. The first four steps take `slow` times the work.
int due_after_slow_steps(RebalanceRule& rule, double slow) {
    for (int step = 0;; ++step) {
        const double mean = step < 4 ? slow : 1;
        rule.add({mean, mean * (1 + 0.002 * step)});
        if (rule.is_due()) return step + 1;
    }
}

// The first four steps of each cycle take five times the work: 16 beyond the cost of 1.
TEST(RebalanceRule, adds_slow_steps_after_each_rebalance_to_its_cost) {
    const auto due = [](double slow) {
        RebalanceRule rule = after_rebalance(1);
        due_after_slow_steps(rule, slow);
        rule.rebalanced(1, 1);
        return due_after_slow_steps(rule, slow);
    };
    const double best = std::sqrt(2 * 1 / 0.002);
    EXPECT_GE(due(1), best);
    EXPECT_LE(due(1), 1.4 * best);
    const double slow_best = std::sqrt(2 * (1 + 16) / 0.002);
    EXPECT_GE(due(5), 0.9 * slow_best);
    EXPECT_LE(due(5), 1.4 * slow_best);
}

TEST(RebalanceRule, takes_slow_steps_of_the_start_for_no_cost_of_a_rebalance) {
    RebalanceRule slow = after_rebalance(1);
    RebalanceRule usual = after_rebalance(1);
    EXPECT_LE(due_after_slow_steps(slow, 30), 1.2 * due_after_slow_steps(usual, 1));
}

TEST(RebalanceRule, does_not_wait_for_ever_after_a_dear_first_rebalance) {
    const auto growth = [](int step) { return 0.002 * step; };
    RebalanceRule dear = after_rebalance(10, 1, 1);
    const double best = std::sqrt(2 * (10.0 / 3) / 0.002);
    EXPECT_LE(first_due(dear, growth), 1.4 * best);
}

/// Clock of ranks that adds noise of a relative deviation to each step.
struct NoisyRanks {
    std::mt19937 random;
    double deviation;
    std::vector<PointCost> costs = std::vector<PointCost>(8);

    /// Loads of points 1 + excess on rank 0, and the others'; with smoothed costs or as measured.
    StepLoad step(double excess, bool smooth) {
        double sum = 0;
        StepLoad load;
        for (std::size_t rank = 0; rank < costs.size(); ++rank) {
            const double points = 1 + (rank == 0 ? excess : -excess / 7);
            const auto uniform = static_cast<double>(random()) / 0x1p32;
            const double seconds = points * (1 + deviation * std::sqrt(12.0) * (uniform - 0.5));
            const double mine = smooth ? costs[rank].smoothed(seconds, points) : seconds;
            sum += mine;
            load.heaviest = std::max(load.heaviest, mine);
        }
        load.mean = sum / 8;
        return load;
    }
};

int num_rebalances(unsigned seed, double deviation, double growth, bool smooth) {
    NoisyRanks ranks{std::mt19937(seed), deviation};
    RebalanceRule rule = after_rebalance(5);
    int calls = 0;
    for (int step = 0, made = 0; step < 1000; ++step) {
        rule.add(ranks.step(growth * (step - made), smooth));
        if (!rule.is_due()) continue;
        ++calls;
        made = step + 1;
        rule.rebalanced(5, 1);
    }
    return calls;
}

TEST(RebalanceRule, takes_little_noise_for_imbalance) {
    for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
        EXPECT_LE(num_rebalances(seed, 0.1, 0, true), 1) << seed;
        EXPECT_LE(num_rebalances(seed, 0.1, 0, false), 5) << seed;  // 2 % of the time
    }
}

TEST(RebalanceRule, rebalances_equal_physics_alike_under_noise) {
    const int calls = num_rebalances(0, 0, 0.002, true);
    EXPECT_LE(calls, 14);  // 1000 / sqrt(2 * 5 / 0.002)
    EXPECT_GE(calls, 9);
    for (const unsigned seed : {1U, 2U, 3U, 4U, 5U})
        for (const double noise : {0.03, 0.06, 0.1})
            EXPECT_NEAR(num_rebalances(seed, noise, 0.002, true), calls, 1) << noise << ' ' << seed;
}

}  // namespace
}  // namespace rrcb
