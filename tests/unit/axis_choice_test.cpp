#include "bisection/axis_choice.hpp"

#include "../support/common.hpp"
#include "bisection/bisection.hpp"
#include "cuts/tree.hpp"
#include "options/allowed_axes.hpp"

namespace rrcb {
namespace {

Box box_of(double x, double y, double z = 0) {
    Box box;
    box.lower = {0, 0, 0};
    box.upper = {x, y, z};
    return box;
}

Options options_of(int num_parts) {
    Options options{.num_parts = num_parts};
    return options;
}

TEST(LongestAxis, is_the_first_that_is_long_enough) {
    EXPECT_EQ(longest_axis(box_of(2, 3), first_axes(2), 1), 1);
    EXPECT_EQ(longest_axis(box_of(3, 3), first_axes(2), 1), 0);
    EXPECT_EQ(longest_axis(box_of(2.8, 3), first_axes(2), 0.9), 0);
    EXPECT_EQ(longest_axis(box_of(2.6, 3), first_axes(2), 0.9), 1);
    EXPECT_EQ(longest_axis(box_of(2.8, 3), std::vector<int>{1, 0}, nearly), 1);
    EXPECT_EQ(longest_axis(box_of(2.8, 3), first_axes(2), nearly), 0);
    EXPECT_EQ(longest_axis(box_of(1, 2, 3), first_axes(2), 1), 1)
        << "the third is none of the axes";
    EXPECT_EQ(longest_axis(box_of(1, 2, 3), first_axes(3), 1), 2);
}

TEST(LongestAxis, does_not_overflow) {
    Box box = box_of(1e308, 1.7e308);
    box.lower = {-1e308, -1.7e308, 0};
    EXPECT_EQ(longest_axis(box, first_axes(2), 1), 1);
}

TEST(AxisChoice, crosses_the_axes_of_one_group_after_the_other) {
    struct Grouped {
        int num_parts;
        Box box;
        int dimension;
        std::vector<int> order;
        std::vector<int> axes;  ///< across which each level is cut
    };
    // Halving the longest extent of 4 x 2 three times: across x, x and y. Nine parts take four
    // levels: the longest extent of 8 x 8 x 1 is halved across x, y, x and y. Axes of groups that
    // the points do not have are left out.
    for (const Grouped& of : {Grouped{8, box_of(4, 2), 2, {1, 0}, {1, 0, 0}},
                              {8, box_of(4, 2, 100), 2, {2, 1, 0}, {1, 0, 0}},
                              {9, box_of(8, 8, 1), 3, {2, 0, 1}, {0, 0, 1, 1}}}) {
        Options options = options_of(of.num_parts);
        options.expert.axes.order = AxisOrder::grouped(of.order);
        const AxisChoice choice(options, of.box, of.dimension);
        for (int depth = 0; depth < static_cast<int>(of.axes.size()); ++depth)
            EXPECT_EQ(choice(0, depth).front(), of.axes[static_cast<std::size_t>(depth)]);
    }
}

TEST(AxisChoice, crosses_the_axis_that_a_cut_was_given) {
    Options options = options_of(3);
    options.expert.axes.order = AxisOrder::given({1, 0});
    const AxisChoice choice(options, box_of(4, 2), 2);
    EXPECT_EQ(choice(0, 0).front(), 1);
    EXPECT_EQ(choice(1, 1).front(), 0);
}

TEST(LongestAxis, of_a_place_is_the_first) {
    EXPECT_EQ(longest_axis(box_of(0, 0, 0), first_axes(3), 1), 0);
    EXPECT_EQ(longest_axis(box_of(0, 0, 5e-324), first_axes(3), 1), 0) << "half of it is nothing";
}

/// Patches of a layer of 10 x 0.2, and two far points that make its box high.
StatisticalDomain layer_with_strays() {
    StatisticalDomain domain{2, {{{0, -2, 0}, {0, -2, 0}, 1e-3}, {{10, 12, 0}, {10, 12, 0}, 1e-3}}};
    for (int i = 0; i < 20; ++i)
        for (const double y : {5.0, 5.1})
            domain.patches.push_back({{i / 2.0, y, 0}, {i / 2.0 + 0.5, y + 0.1, 0}, 1});
    return domain;
}

Cuts cuts_by(const AxisOrder& order, StatisticalDomain domain, int num_parts,
             GlobalCount num_points = 0, const std::vector<int>& preferred = {}) {
    Options options{.num_parts = num_parts};
    options.part_sizes.assign(static_cast<std::size_t>(num_parts), 1);
    options.expert.axes.order = order;
    return bisect(std::move(domain), options, false, num_points, preferred).cuts;
}

std::vector<int> axes_by(const AxisOrder& order, StatisticalDomain domain, int num_parts) {
    return axes_of(cuts_by(order, std::move(domain), num_parts).tree);
}

/// 8 x 8 patches of x by y.
StatisticalDomain even_box(double x, double y) {
    StatisticalDomain domain{2, {}};
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j)
            domain.patches.push_back({{i * x, j * y, 0}, {(i + 1) * x, (j + 1) * y, 0}, 1});
    return domain;
}

TEST(AxisRule, crosses_the_axis_with_the_least_weight_near_the_cut) {
    const StatisticalDomain layer = layer_with_strays();
    EXPECT_EQ(axes_by({}, layer, 4), (std::vector<int>{0, 0, 0}));
    EXPECT_EQ(axes_by(AxisOrder::longest(), layer, 4), (std::vector<int>{1, 0, 0}));
    EXPECT_EQ(axes_by(AxisOrder::among({1}), layer, 4), (std::vector<int>{1, 1, 1}));
    EXPECT_EQ(axes_by(AxisOrder::among({1, 0}), layer, 4), (std::vector<int>{0, 0, 0}));
}

TEST(AxisRule, crosses_the_longest_axis_of_few_points) {
    const StatisticalDomain layer = layer_with_strays();
    EXPECT_EQ(axes_of(cuts_by({}, layer, 4, 1000).tree), axes_by({}, layer, 4));
    EXPECT_EQ(axes_of(cuts_by({}, layer, 4, 16).tree), axes_by(AxisOrder::longest(), layer, 4));
}

TEST(AxisRule, crosses_the_longest_axis_unless_another_saves_a_tenth) {
    EXPECT_EQ(axes_by({}, even_box(1, 1), 4), (std::vector<int>{0, 1, 1}));
    EXPECT_EQ(axes_by({}, even_box(1, 1.08), 2), (std::vector<int>{0}));
    EXPECT_EQ(axes_by({}, even_box(1, 1.2), 2), (std::vector<int>{1}));
    EXPECT_EQ(axes_by(AxisOrder::among({1, 0}), even_box(1.08, 1), 2), (std::vector<int>{1}));
    // Without sides of patches the box counts.
    StatisticalDomain corners{2, {{{0, 0, 0}, {0, 0, 0}, 1}, {{1, 2, 0}, {1, 2, 0}, 1}}};
    EXPECT_EQ(axes_by({}, corners, 2), (std::vector<int>{1}));
}

TEST(PreferredAxes, are_taken_where_points_extend_along_them) {
    const auto axes = [](const AxisOrder& order, double height, std::vector<int> preferred) {
        return axes_of(cuts_by(order, even_box(1, height), 4, 0, preferred).tree);
    };
    EXPECT_EQ(axes({}, 1.5, {0, 0, 0}), (std::vector<int>{0, 0, 0}));
    EXPECT_EQ(axes(AxisOrder::longest(), 1.08, {0, 1, 1}), (std::vector<int>{0, 1, 1}));
    EXPECT_EQ(axes(AxisOrder::longest(), 1.2, {0, 1, 1}), (std::vector<int>{1, 0, 0}));
    EXPECT_EQ(axes(AxisOrder::among({1}), 1, {0, 0, 0}), (std::vector<int>{1, 1, 1}));
    StatisticalDomain line{2, {{{0, 0, 0}, {1, 0, 0}, 1}}};
    EXPECT_EQ(axes_of(cuts_by({}, line, 2, 0, {1}).tree), (std::vector<int>{0}));
}

TEST(KeptAxes, are_good_if_all_cuts_together_have_about_as_much_weight_near) {
    const StatisticalDomain square = even_box(1, 1);
    const Cuts fresh = cuts_by({}, square, 4);
    EXPECT_TRUE(are_axes_good(square, cuts_by({}, square, 4), fresh, 0.85));
    EXPECT_FALSE(are_axes_good(square, cuts_by(AxisOrder::among({0}), square, 4), fresh, 0.85));
    // Four quarters in another order: the first cut is the worse, the others are the better.
    const StatisticalDomain high = even_box(1, 1.4);
    const Cuts quarters = cuts_by(AxisOrder::given({0, 1, 1}), high, 4);
    EXPECT_EQ(axes_by({}, high, 4), (std::vector<int>{1, 0, 0}));
    EXPECT_TRUE(are_axes_good(high, quarters, cuts_by({}, high, 4), 0.85));
}

}  // namespace
}  // namespace rrcb
