#include "bisection/axis_choice.hpp"

#include <gtest/gtest.h>

namespace rrcb {
namespace {

Box box_of(double x, double y, double z = 0) {
    Box box;
    box.lower = {0, 0, 0};
    box.upper = {x, y, z};
    return box;
}

Options options_of(int num_parts) {
    Options options;
    options.num_parts = num_parts;
    return options;
}

TEST(LongestAxis, is_the_first_that_is_long_enough) {
    EXPECT_EQ(longest_axis(box_of(2, 3), 2, 1), 1);
    EXPECT_EQ(longest_axis(box_of(3, 3), 2, 1), 0);
    EXPECT_EQ(longest_axis(box_of(2.8, 3), 2, 0.9), 0);
    EXPECT_EQ(longest_axis(box_of(2.6, 3), 2, 0.9), 1);
    EXPECT_EQ(longest_axis(box_of(1, 2, 3), 2, 1), 1) << "the third is none of the axes";
    EXPECT_EQ(longest_axis(box_of(1, 2, 3), 3, 1), 2);
}

TEST(LongestAxis, does_not_overflow) {
    Box box = box_of(1e308, 1.7e308);
    box.lower = {-1e308, -1.7e308, 0};
    EXPECT_EQ(longest_axis(box, 2, 1), 1);
}

TEST(AxisChoice, takes_nearly_equal_axes_as_equal) {
    const Box box = box_of(2.8, 3);
    EXPECT_EQ(AxisChoice(options_of(4), box, 2)(0, 0, box), 0);
}

TEST(AxisChoice, crosses_the_axes_of_one_group_after_the_other) {
    // Halving the longest extent of 4 x 2 three times: across x, x and y.
    Options options = options_of(8);
    options.axes.order = AxisOrder::grouped({1, 0});
    const AxisChoice choice(options, box_of(4, 2), 2);
    for (const auto& [depth, axis] : {std::pair{0, 1}, std::pair{1, 0}, std::pair{2, 0}})
        EXPECT_EQ(choice(0, depth, box_of(1, 1)), axis);
}

TEST(AxisChoice, crosses_the_axis_that_a_cut_was_given) {
    Options options = options_of(3);
    options.axes.order = AxisOrder::given({1, 0});
    const AxisChoice choice(options, box_of(4, 2), 2);
    EXPECT_EQ(choice(0, 0, box_of(4, 2)), 1);
    EXPECT_EQ(choice(1, 1, box_of(1, 2)), 0);
}

TEST(AxisChoice, leaves_out_axes_of_the_groups_that_the_points_do_not_have) {
    Options options = options_of(8);
    options.axes.order = AxisOrder::grouped({2, 1, 0});
    const AxisChoice choice(options, box_of(4, 2, 100), 2);
    for (const auto& [depth, axis] : {std::pair{0, 1}, std::pair{1, 0}, std::pair{2, 0}})
        EXPECT_EQ(choice(0, depth, box_of(1, 1)), axis);
}

TEST(AxisChoice, has_an_axis_for_every_level_of_the_groups) {
    // Nine parts take four levels: the longest extent of 8 x 8 x 1 is halved across x, y, x and y.
    Options options = options_of(9);
    options.axes.order = AxisOrder::grouped({2, 0, 1});
    const AxisChoice choice(options, box_of(8, 8, 1), 3);
    for (const auto& [depth, axis] :
         {std::pair{0, 0}, std::pair{1, 0}, std::pair{2, 1}, std::pair{3, 1}})
        EXPECT_EQ(choice(0, depth, box_of(1, 1, 1)), axis);
}

TEST(LongestAxis, of_a_place_is_the_first) {
    EXPECT_EQ(longest_axis(box_of(0, 0, 0), 3, 1), 0);
    EXPECT_EQ(longest_axis(box_of(0, 0, 5e-324), 3, 1), 0) << "half of it is nothing";
}

}  // namespace
}  // namespace rrcb
