// Targets and slack worked out by hand, and that slack spent on every level keeps the tolerance.
#include "search/target_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rrcb {
namespace {

TargetRule rule_of(const std::vector<double>& sizes, double tolerance, double common_weight = 0) {
    TargetRule rule;
    rule.part_sizes = sizes;
    rule.tolerance = tolerance;
    rule.common_weight = common_weight;
    rule.weight_per_size = 100;
    return rule;
}

TEST(TargetRule, gives_each_side_the_share_of_its_sizes) {
    const std::vector<double> sizes{1, 2, 3, 0, 2};
    const TargetRule rule = rule_of(sizes, 1.1);
    const Descent top{0, 0, 5};  // parts 0 and 1 below
    EXPECT_EQ(rule.target_of(top, 800).target, 300);
    EXPECT_EQ(rule.target_of(top, 400).target, 150) << "of what was counted, not of the ideal";
    EXPECT_EQ(rule.share_below({0, 3, 2}), 0) << "nothing belongs to a part of size 0";
    EXPECT_EQ(rule.target_of(top, 0).target, 0);
}

TEST(TargetRule, of_exact_cuts_leaves_half_a_point_of_slack) {
    const std::vector<double> sizes{1, 1};
    TargetRule rule = rule_of(sizes, 1.1, 4);
    rule.is_exact = true;
    EXPECT_EQ(rule.target_of({0, 0, 2}, 200).slack, 2);
    rule.common_weight = 0;
    EXPECT_EQ(rule.target_of({0, 0, 2}, 200).slack, 0);
}

TEST(TargetRule, knows_tolerances_below_the_weight_of_a_point) {
    const std::vector<double> sizes{1, 1};  // each to weigh 100
    TargetRule rule = rule_of(sizes, 1.0625);
    rule.heaviest = 6.25;
    EXPECT_TRUE(rule.is_attainable());
    rule.heaviest = 6.5;
    EXPECT_FALSE(rule.is_attainable());
}

TEST(TargetRule, of_exact_cuts_prefers_the_side_that_a_point_takes_the_least_beyond_its_size) {
    // Of 10 points of weight 1 the sides are to have 1.6 and 8.4. With 2 and 8 the lower one has
    // 1.25 times its own, with 1 and 9 the upper one has 1.07 times.
    const std::vector<double> sizes{1.6, 8.4};
    TargetRule rule = rule_of(sizes, 1.1, 1);
    rule.is_exact = true;
    const CutTarget target = rule.target_of({0, 0, 2}, 10);
    EXPECT_LT(target.excess(1), target.excess(2));
    EXPECT_LE(target.excess(1), target.slack);
    EXPECT_GT(target.excess(2), target.slack);
    EXPECT_GT(target.excess(0), target.slack);
    EXPECT_NEAR(target.excess(2) / target.excess(1), (2 / 1.6 - 1) / (9 / 8.4 - 1), 1e-2);
}

TEST(TargetRule, spends_all_slack_on_the_last_level_and_a_root_of_it_above) {
    const std::vector<double> sizes(8, 1.0);
    const TargetRule rule = rule_of(sizes, 1.331);
    EXPECT_NEAR(rule.target_of({0, 0, 2}, 200).slack, 33.1, 1e-10);
    EXPECT_NEAR(rule.target_of({0, 0, 8}, 800).slack, 40, 1e-10);  // 1.331 is 1.1 cubed
    // Two of three parts are cut once more.
    const CutTarget target = rule_of(sizes, 1.21).target_of({0, 0, 3}, 300);
    EXPECT_NEAR(target.slack, target.excess(110), 1e-10);
    EXPECT_NEAR(target.slack, target.excess(300 - 220), 1e-10);
}

TEST(TargetRule, lets_each_side_exceed_its_size_by_the_same_factor) {
    const std::vector<double> sizes{1, 3};
    const CutTarget target = rule_of(sizes, 1.1).target_of({0, 0, 2}, 400);
    EXPECT_NEAR(target.slack, target.excess(110), 1e-10);
    EXPECT_NEAR(target.slack, target.excess(400 - 330), 1e-10);
    const std::vector<double> other_way_round{3, 1};
    const CutTarget other = rule_of(other_way_round, 1.1).target_of({0, 0, 2}, 400);
    EXPECT_NEAR(other.slack, other.excess(330), 1e-10);
    EXPECT_NEAR(other.slack, other.excess(400 - 110), 1e-10);
}

TEST(TargetRule, leaves_a_node_that_is_too_heavy_less_slack_and_in_the_end_none) {
    const std::vector<double> sizes{1, 1};
    const TargetRule rule = rule_of(sizes, 1.1);
    EXPECT_NEAR(rule.target_of({0, 0, 2}, 210).slack, (1.1 / 1.05 - 1) * 105, 1e-10);
    EXPECT_EQ(rule.target_of({0, 0, 2}, 220 + 1e-9).slack, 0);
}

TEST(TargetRule, counts_on_whole_points_where_all_weigh_the_same) {
    // 100 and a tenth are room for 11 points of weight 10, 100 and a twentieth only for 10 of them.
    const std::vector<double> sizes{1, 1};
    EXPECT_NEAR(rule_of(sizes, 1.1, 10).target_of({0, 0, 2}, 200).slack, 10, 1e-10);
    EXPECT_EQ(rule_of(sizes, 1.05, 10).target_of({0, 0, 2}, 200).slack, 5) << "half a point";
    // The smallest part with a size decides: 25 and a tenth are room for 2 points.
    const std::vector<double> uneven{1, 0.25, 0, 3};
    EXPECT_NEAR(rule_of(uneven, 1.1, 10).target_of({0, 0, 4}, 425).slack,
                2 * 10 * (1.25 / 4.25) * (3 / 4.25), 1e-10)
        << "the point on the target";
    const std::vector<double> with_none{1, 0.5, 0, 2.5};
    EXPECT_NEAR(rule_of(with_none, 1.2, 10).target_of({0, 0, 4}, 400).slack,
                (std::sqrt(1.2) - 1) * 400 * 2 * 0.375 * 0.625, 1e-10);
}

TEST(TargetRule, keeps_every_part_within_the_tolerance_however_the_slack_is_spent) {
    for (const int num_parts : {2, 3, 5, 8, 13}) {
        const std::vector<double> sizes(static_cast<std::size_t>(num_parts), 1.0);
        const TargetRule rule = rule_of(sizes, 1.05);
        // Each cut errs as far as it may, to either side.
        const auto heaviest = [&](auto&& again, const Descent& at, double weight) -> double {
            if (at.is_part()) return weight;
            const CutTarget target = rule.target_of(at, weight);
            double most = 0;
            for (const double below : {target.target - target.slack / (2 * target.share),
                                       target.target + target.slack / (2 * (1 - target.share))})
                most = std::max({most, again(again, at.lower(), below),
                                 again(again, at.upper(), weight - below)});
            return most;
        };
        EXPECT_LE(heaviest(heaviest, {0, 0, num_parts}, 100.0 * num_parts), 105 + 1e-9)
            << num_parts;
    }
}

TEST(TargetRule, lets_cuts_stay_whose_sides_can_be_mended_below_or_need_no_mending) {
    const std::vector<double> sizes(4, 1.0);
    TargetRule rule = rule_of(sizes, 1.1);
    rule.counted_weight = 400;
    const Descent top{0, 0, 4};
    EXPECT_TRUE(rule.may_stay(top, std::vector<double>{120, 80, 100, 100}));
    EXPECT_FALSE(rule.may_stay({1, 0, 2}, std::vector<double>{120, 80, 100, 100}));
    EXPECT_TRUE(rule.may_stay({2, 2, 2}, std::vector<double>{120, 80, 100, 100}));
    // 216 of at most 220 leave too little room for the cut below; but here it need not move.
    EXPECT_FALSE(rule.may_stay(top, std::vector<double>{120, 96, 92, 92}));
    EXPECT_TRUE(rule.may_stay(top, std::vector<double>{108, 108, 70, 114}));
    EXPECT_TRUE(rule.are_within(top, std::vector<double>{110, 110, 70, 110}));
    EXPECT_FALSE(rule.are_within(top, std::vector<double>{110, 110, 69, 111}));
    EXPECT_TRUE(rule.are_within({1, 0, 2}, std::vector<double>{110, 110, 69, 111}));
}

}  // namespace
}  // namespace rrcb
