// When a rebalance is due: series of loads whose answer is worked out by hand.
#include "controller/rebalance_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(LoadWindow, shows_no_outlier) {
    LoadWindow window;
    window.add(1, 10);
    EXPECT_EQ(window.excess(), 1);
    window.add(9, 90);
    EXPECT_EQ(window.excess(), 1);
    window.add(2, 20);
    EXPECT_EQ(window.excess(), 2);
    EXPECT_EQ(window.mean(), 20);
    window.add(3, 30);
    window.add(0, 0);
    EXPECT_EQ(window.excess(), 2);
    EXPECT_EQ(window.mean(), 20);
    window.clear();
    EXPECT_EQ(window.count(), 0U);
}

// Of 3 and of 6 values the smallest lies below the median in 7/8 and 63/64 of all cases; of 12 the
// third smallest in 98 %: 6 - 0.9 sqrt(12) = 2.9 are left out.
TEST(LoadWindow, bounds_the_median_from_below) {
    LoadWindow window;
    for (const double value : {5.0, 7.0}) window.add(value, 1);
    EXPECT_EQ(window.lower_bound(), -infinity);
    window.add(6, 1);
    EXPECT_EQ(window.lower_bound(), 5);
    window.add(0, 1);
    EXPECT_EQ(window.lower_bound(), 0);
    window.clear();
    for (const double value : {1.0, 9.0, 2.0, 8.0, 7.0, 7.0, 7.0, 7.0, 7.0, 7.0, 7.0, 3.0})
        window.add(value, 1);
    EXPECT_EQ(window.lower_bound(), 3);  // 1, 2, 3 of the twelve; 3 of the last three and six
    for (int i = 0; i < 100; ++i) window.add(i < 98 ? 4 : 0, 1);
    EXPECT_EQ(window.lower_bound(), 4);  // two of twelve are too few to tell
}

TEST(LoadWindow, bounds_the_median_from_above) {
    LoadWindow window;
    for (int i = 0; i < 11; ++i) window.add(i, 1);
    EXPECT_EQ(window.upper_bound(), infinity);
    window.add(11, 1);
    EXPECT_EQ(window.upper_bound(), 9);  // 10 and 11 are left out, as 0 and 1 are from below
    for (int i = 0; i < 12; ++i) window.add(i < 2 ? 7 : 1, 1);
    EXPECT_EQ(window.upper_bound(), 1);
}

// The program starts slowly on one rank; what comes after that is no floor.
TEST(RebalanceRule, sees_a_jump_after_a_slow_start) {
    RebalanceRule rule;
    rule.rebalanced(10, 1);
    for (int i = 0; i < 2; ++i) rule.add({1, 4});
    for (int i = 0; i < 48; ++i) {
        rule.add({1, 1});
        EXPECT_FALSE(rule.is_due()) << i;
    }
    int waited = 0;
    for (; !rule.is_due() && waited < 100; ++waited) rule.add({1, 2.5});
    EXPECT_LE(waited, 10);
}

// 4.1 / 4.1 of three ranks may differ from 1 by rounding.
TEST(RebalanceRule, takes_rounding_for_no_imbalance) {
    RebalanceRule rule;
    rule.rebalanced(0, 1);
    for (int i = 0; i < 1000; ++i) {
        rule.add({1, 1 + (i % 3 == 0 ? 0 : 4e-16)});
        EXPECT_FALSE(rule.is_due()) << i;
    }
}

TEST(WasteHistory, tells_what_lasts_of_a_level) {
    WasteHistory history;
    // Up to 2 and down again: since it was first there, the mean is (2 + 1 + 0 + 1 + 2) / 5.
    for (const double excess : {0.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0}) history.add(excess, 3);
    EXPECT_EQ(history.work(), 21);
    EXPECT_EQ(history.waste(), 21);
    EXPECT_DOUBLE_EQ(history.mean_since(2), 1.2);
    EXPECT_DOUBLE_EQ(history.mean_since(0), 1);
    EXPECT_EQ(history.mean_since(5), 5);
    // From the end: 2, 1, and nothing beyond the step without excess.
    EXPECT_DOUBLE_EQ(history.lasting_waste(0), 9);
    EXPECT_DOUBLE_EQ(history.lasting_waste(0.5), 6);
    history.clear();
    EXPECT_EQ(history.work(), 0);
    EXPECT_EQ(history.lasting_waste(0), 0);
}

TEST(WasteHistory, keeps_its_sums_however_long) {
    WasteHistory history;
    for (int step = 0; step < 1000; ++step) history.add(step < 512 ? 0 : 1, 2);
    EXPECT_EQ(history.work(), 2000);
    EXPECT_EQ(history.waste(), 976);
    EXPECT_DOUBLE_EQ(history.mean_since(1), 1);
    EXPECT_DOUBLE_EQ(history.lasting_waste(0), 976);
}

/// First step (from 1) after which a rebalance is due, of at most 1000; 0 where there is none.
int first_due(RebalanceRule& rule, const std::function<double(int step)>& excess, double mean = 1) {
    for (int step = 0; step < 1000; ++step) {
        rule.add({mean, mean * (1 + excess(step))});
        if (rule.is_due()) return step + 1;
    }
    return 0;
}

RebalanceRule after_rebalance(double cost, double least_imbalance = 1) {
    RebalanceRule rule;
    rule.rebalanced(cost, least_imbalance);
    return rule;
}

TEST(RebalanceRule, leaves_an_imbalance_that_a_rebalance_does_not_remove) {
    for (const double excess : {0.0, 0.1, 3.0}) {
        RebalanceRule rule = after_rebalance(0.5);
        EXPECT_EQ(first_due(rule, [&](int) { return excess; }), 0) << excess;
    }
}

// After n steps the smallest of the last three is s (n - 3). The medians of three are 0, 0, s, 2 s,
// ... s (n - 2), so the mean cost is (C + s (n - 1) (n - 2) / 2) / n, and it is reached where
// n^2 - 3 n - 2 >= 2 C / s: near sqrt(2 C / s), and three steps late.
TEST(RebalanceRule, rebalances_linear_growth_where_the_mean_cost_is_least) {
    RebalanceRule rare = after_rebalance(50);
    EXPECT_EQ(first_due(rare, [](int step) { return 0.01 * step; }), 102);
    RebalanceRule frequent = after_rebalance(0.5);
    EXPECT_EQ(first_due(frequent, [](int step) { return 0.01 * step; }), 12);
}

TEST(RebalanceRule, decides_by_loads_and_costs_of_one_unit_whichever_it_is) {
    for (const double unit : {1e-300, 0.001, 1e290}) {
        RebalanceRule rule = after_rebalance(50 * unit);
        EXPECT_EQ(first_due(
                      rule, [](int step) { return 0.01 * step; }, unit),
                  102)
            << unit;
    }
}

// Fifty steps without waste, then 0.5. After the 53rd step three show it, and two of them are
// counted: 0.5 >= (C + 1) / 53 where C <= 25.5.
TEST(RebalanceRule, rebalances_a_jump_as_soon_as_it_is_no_outlier) {
    const auto jump = [](int step) { return step < 50 ? 0 : 0.5; };
    RebalanceRule rule = after_rebalance(25.4);
    EXPECT_EQ(first_due(rule, jump), 53);
    // Beyond, once what has lasted would have paid: 0.5 (n - 52) >= C, as the first step that shows
    // it shares its stretch of two with one that does not.
    RebalanceRule costly = after_rebalance(26);
    EXPECT_EQ(first_due(costly, jump), 104);
}

TEST(RebalanceRule, ignores_single_slow_steps) {
    RebalanceRule rule = after_rebalance(0.5);
    EXPECT_EQ(first_due(rule, [](int step) { return step % 10 == 5 ? 50.0 : 0.0; }), 0);
}

// 1 - cos of 40 steps' period and of mean 1: a whole swing wastes no more than 40; at the first
// crest 20 * 2 < 40 + 20, and no later one counts for more than the mean.
TEST(RebalanceRule, does_not_chase_what_comes_and_goes) {
    const auto swing = [](int step) { return 1 - std::cos(step * 3.14159265358979 / 20); };
    RebalanceRule rule = after_rebalance(40);
    EXPECT_EQ(first_due(rule, swing), 0);
}

TEST(RebalanceRule, expects_no_gain_below_the_least_imbalance) {
    RebalanceRule rule = after_rebalance(0.5, 4);
    EXPECT_EQ(first_due(rule, [](int step) { return step < 50 ? 0 : 2.9; }), 0);
    RebalanceRule above = after_rebalance(0.5, 4);
    EXPECT_EQ(first_due(above, [](int step) { return step < 50 ? 0 : 3.1; }), 53);
}

// A rebalance of unknown cost is taken for one step: the smallest of 0.25, ... is enough as soon as
// 0.25 a step adds up to it.
TEST(RebalanceRule, takes_the_first_rebalance_for_a_step) {
    RebalanceRule rule;
    EXPECT_EQ(first_due(rule, [](int) { return 0.25; }), 4);
    RebalanceRule balanced;
    EXPECT_EQ(first_due(balanced, [](int) { return 0; }), 0);
}

TEST(RebalanceRule, says_nothing_of_steps_without_load) {
    RebalanceRule rule;
    for (int step = 0; step < 100; ++step) rule.add({0, 0});
    EXPECT_FALSE(rule.is_due());
}

/// After two cycles of so many steps and constant excess, with rebalances of cost 10.
RebalanceRule after_cycles(int first, double first_excess, int second, double second_excess) {
    RebalanceRule rule = after_rebalance(10);
    for (int step = 0; step < first; ++step) rule.add({1, 1 + first_excess});
    rule.rebalanced(10, 1);
    for (int step = 0; step < second; ++step) rule.add({1, 1 + second_excess});
    rule.rebalanced(10, 1);
    return rule;
}

// The cycles count 1/2 and 1: 1.5 rebalances, work 150 and waste 50. With this one the mean cost
// after 13 steps, two of which count, is (25 + 50 + 2 x) / 163, which x = 0.48 exceeds. Later it
// stays above 0.45, and 0.45 (n - 11) >= 10 decides.
TEST(RebalanceRule, judges_a_jump_by_earlier_cycles) {
    RebalanceRule high = after_cycles(100, 1, 100, 0);
    EXPECT_EQ(first_due(high, [](int step) { return step < 10 ? 0 : 0.48; }), 13);
    RebalanceRule low = after_cycles(100, 1, 100, 0);
    EXPECT_EQ(first_due(low, [](int step) { return step < 10 ? 0 : 0.45; }), 34);
}

// 10 + 4 for 20 steps are more than 0.2 a step: the rebalance has not paid. The mean cost stays
// above 0.45 as before, now (25 + 14 + ...) / (70 + n), and 0.45 (n - 11) >= 2 * 10 decides.
TEST(RebalanceRule, is_more_patient_after_a_rebalance_that_did_not_pay) {
    RebalanceRule rule = after_cycles(100, 0.2, 20, 0.2);
    EXPECT_EQ(first_due(rule, [](int step) { return step < 10 ? 0 : 0.45; }), 56);
}

// Of costs 1, 100 and 1 the outlier does not count for more than twice the median, 2: growth is
// rebalanced as for 2, n^2 - 3 n - 2 >= 2 * 2 / s, less what the past cycles add.
TEST(RebalanceRule, does_not_take_one_costly_rebalance_for_the_rule) {
    const auto growth = [](int step) { return 0.01 * step; };
    RebalanceRule rule = after_rebalance(1);
    EXPECT_EQ(first_due(rule, growth), 16);
    rule.rebalanced(1, 1);
    EXPECT_EQ(first_due(rule, growth), 16);
    rule.rebalanced(100, 1);
    EXPECT_LE(first_due(rule, growth), 23);
}

}  // namespace
}  // namespace rrcb
