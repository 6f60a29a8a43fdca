// Numbers of parts after a turn, and the debt that decides on it, by hand and by sampled points.
#include "estimate/turning.hpp"

#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "arithmetic/non_stop.hpp"
#include "bisection/common_weight.hpp"
#include "options/validation.hpp"

namespace rrcb {
namespace {

constexpr double least = -std::numeric_limits<double>::infinity();

Cut across(int axis, double value) {
    Cut cut{axis, 0, {least, least, least}};
    cut.at[static_cast<std::size_t>(axis)] = value;
    return cut;
}

StatisticalDomain unit_square() {
    return {2, {{{0, 0, 0}, {1, 1, 0}, 12}}};
}

/// Four quarters of the unit square, cut across x first or across y first.
Cuts quarters(int first) {
    return {2, 4, {across(first, 0.5), across(1 - first, 0.5), across(1 - first, 0.5)}};
}

/// The cuts that halve a box again and again across random axes.
void halve(const Box& box, int num_parts, int dimension, std::mt19937& random, Cuts& cuts) {
    if (num_parts == 1) return;
    const int axis = std::uniform_int_distribution<>(0, dimension - 1)(random);
    const double share = std::uniform_real_distribution<>(0.2, 0.8)(random);
    const double value = std::lerp(box.lower[axis], box.upper[axis], share);
    cuts.tree.push_back(across(axis, value));
    Box below = box;
    Box above = box;
    below.upper[axis] = above.lower[axis] = value;
    halve(below, num_parts / 2, dimension, random, cuts);
    halve(above, num_parts - num_parts / 2, dimension, random, cuts);
}

TEST(CommonWeight, of_quarters_is_all_or_nothing) {
    const auto common = common_weights(unit_square(), quarters(1), quarters(0));
    ASSERT_EQ(common.size(), 4u);
    const std::vector<Part> expected{0, 2, 1, 3};
    for (const auto& [end, part, weight] : common) {
        EXPECT_EQ(part, expected[static_cast<std::size_t>(end)]);
        EXPECT_DOUBLE_EQ(weight, 3);
    }
}

TEST(CommonWeight, is_the_share_of_a_fine_lattice) {
    std::mt19937 random(5);
    const Box unit{{0, 0, 0}, {1, 1, 1}};
    for (const int num_parts : {1, 2, 5, 9}) {
        Cuts one{3, num_parts, {}};
        Cuts other{3, num_parts, {}};
        halve(unit, num_parts, 3, random, one);
        halve(unit, num_parts, 3, random, other);
        other.numbers.resize(static_cast<std::size_t>(num_parts));
        std::iota(other.numbers.rbegin(), other.numbers.rend(), 0);
        std::map<std::pair<Part, Part>, double> expected;
        constexpr int fine = 60;
        for (int k = 0; k < fine * fine * fine; ++k) {
            const auto at = [&](int i) { return (i % fine + 0.5) / fine; };
            const Vector x{at(k), at(k / fine), at(k / fine / fine)};
            expected[{part_of(one, x), part_of(other, x)}] += 1.0 / (fine * fine * fine);
        }
        for (const auto& [end, part, weight] :
             common_weights({3, {{{0, 0, 0}, {1, 1, 1}, 1}}}, one, other)) {
            EXPECT_NEAR(weight, (expected[{end, part}]), 0.03);
            expected.erase({end, part});
        }
        for (const auto& [pair, weight] : expected) EXPECT_EQ(weight, 0);
    }
}

TEST(KeepNumbers, of_quarters_moves_nothing) {
    Cuts cuts = quarters(1);
    EXPECT_EQ(keep_numbers(unit_square(), std::vector<double>(4, 0.25), quarters(0), cuts), 0);
    EXPECT_EQ(cuts.numbers, (std::vector<Part>{0, 2, 1, 3}));
    // Back again: no numbers of their own.
    Cuts back = quarters(0);
    EXPECT_EQ(keep_numbers(unit_square(), std::vector<double>(4, 0.25), cuts, back), 0);
    EXPECT_EQ(back.numbers, (std::vector<Part>{0, 1, 2, 3}));
}

TEST(KeepNumbers, leaves_the_order_as_it_is_if_it_is_best) {
    Cuts cuts = quarters(0);
    cuts.tree[0] = across(0, 0.6);
    EXPECT_NEAR(keep_numbers(unit_square(), {}, quarters(0), cuts), 0.1, 1e-15);
    EXPECT_TRUE(cuts.numbers.empty());
}

TEST(KeepNumbers, of_parts_of_unequal_sizes_follow_the_ends) {
    Cuts cuts = quarters(1);
    EXPECT_DOUBLE_EQ(
        keep_numbers(unit_square(), std::vector<double>{1, 1, 1, 2}, quarters(0), cuts), 0.5);
    EXPECT_TRUE(cuts.numbers.empty());
}

TEST(KeepNumbers, stay_within_the_group_of_a_machine) {
    Cuts earlier = quarters(0);
    Cuts cuts = quarters(1);
    earlier.shape = cuts.shape = {2};
    // Parts 0 and 1 are one machine: the upper half cannot keep points of both.
    EXPECT_DOUBLE_EQ(keep_numbers(unit_square(), {}, earlier, cuts), 0.5);
    std::vector<Part> groups;
    for (Part end = 0; end < 4; ++end) groups.push_back(cuts.part_at(end) / 2);
    EXPECT_EQ(groups[0], groups[1]);
    EXPECT_EQ(groups[2], groups[3]);
    EXPECT_NE(groups[0], groups[2]);
}

TEST(KeepNumbers, keep_at_least_half_of_what_the_best_numbers_keep) {
    std::mt19937 random(11);
    const Box unit{{0, 0, 0}, {1, 1, 0}};
    for (int k = 0; k < 50; ++k) {
        Cuts earlier{2, 6, {}};
        Cuts cuts{2, 6, {}};
        halve(unit, 6, 2, random, earlier);
        halve(unit, 6, 2, random, cuts);
        std::array<std::array<double, 6>, 6> shared{};
        for (const auto& [end, part, weight] : common_weights(unit_square(), cuts, earlier))
            shared[static_cast<std::size_t>(end)][static_cast<std::size_t>(part)] = weight / 12;
        std::array<std::size_t, 6> numbers{0, 1, 2, 3, 4, 5};
        double best = 0;
        do {
            double kept = 0;
            for (std::size_t end = 0; end < 6; ++end) kept += shared[end][numbers[end]];
            best = std::max(best, kept);
        } while (std::ranges::next_permutation(numbers).found);
        const double kept = 1 - keep_numbers(unit_square(), {}, earlier, cuts);
        EXPECT_LE(kept, best + 1e-12);
        EXPECT_GE(kept, best / 2);
        EXPECT_NO_THROW(check_tree(cuts));
    }
}

/// A layer of 16 x 1 of 6,400 points, in 256 even patches of 25 points, which cuts across y divide
/// by the long side.
struct Layer {
    NonStop arithmetic{};  // as in a call
    StatisticalDomain domain{2, {}};
    Contribution all{};
    Options options{};
    Cuts earlier{2, 2, {across(1, 0.5)}};

    Layer() {
        for (int k = 0; k < 256; ++k) {
            const double x = 0.25 * (k % 64);
            const double y = 0.25 * static_cast<double>(k / 64);
            domain.patches.push_back({{x, y, 0}, {x + 0.25, y + 0.25, 0}, 25});
        }
        all.summary.num_points = 6400;
        options.num_parts = 2;
        options.part_sizes = {0.5, 0.5};
    }
};

TEST(BisectAlong, adds_the_ghosts_of_a_step_to_the_debt_until_a_turn_is_paid) {
    Layer layer;
    // Spacing 0.05, so ghosts are within 0.1 of the cut: 0.2 of the weight across y, 0.0125 across
    // x. A turn moves half of the points.
    layer.options.expert.axes.steps = 1;
    const Cuts first = bisect_along(layer.domain, layer.all, layer.options, layer.earlier).cuts;
    EXPECT_EQ(first.tree[0].axis, 1);
    EXPECT_NEAR(first.debt, (0.2 - 0.0125) / 10, 1e-12);
    const Cuts second = bisect_along(layer.domain, layer.all, layer.options, first).cuts;
    EXPECT_NEAR(second.debt, 2 * first.debt, 1e-12);
    layer.options.expert.axes.steps = 50;
    const Cuts turned = bisect_along(layer.domain, layer.all, layer.options, second).cuts;
    EXPECT_EQ(turned.tree[0].axis, 0);
    EXPECT_EQ(turned.debt, 0);
}

TEST(BisectAlong, keeps_axes_that_cost_no_more) {
    Layer layer;
    layer.earlier.tree = {across(0, 7)};
    layer.earlier.debt = 0.25;
    const Cuts cuts = bisect_along(layer.domain, layer.all, layer.options, layer.earlier).cuts;
    EXPECT_EQ(cuts.tree[0].axis, 0);
    EXPECT_DOUBLE_EQ(cuts.tree[0].at[0], 8);
    EXPECT_EQ(cuts.debt, 0.25);
}

}  // namespace
}  // namespace rrcb
