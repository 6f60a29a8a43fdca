#include "refinement/fragments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace rrcb {
namespace {

/// Points on a line in a mesh of two cells.
SortedPoints sorted(const std::vector<double>& x, const std::vector<double>& weights = {}) {
    const Points points = interleaved_points(x, 1, weights);
    return sort_by_cell(bin_by_cell(points, make_support_mesh(bounding_box(points), 1, 2)));
}

Cut cut_at(double value) {
    Cut cut;
    cut.at.fill(-std::numeric_limits<double>::infinity());
    cut.at[0] = value;
    return cut;
}

std::vector<double> positions_in(const std::vector<Fragment>& fragments,
                                 const SortedPoints& points) {
    std::vector<double> positions;
    for (const Fragment& fragment : fragments)
        for (LocalIndex i = fragment.begin; i < fragment.end; ++i)
            positions.push_back(points.position(i)[0]);
    std::ranges::sort(positions);
    return positions;
}

TEST(Fragments, are_the_cells_that_hold_points) {
    const SortedPoints points = sorted({0, 4, 3.5, 1}, {1, 2, 4, 8});
    const auto fragments = cell_fragments(points);
    ASSERT_EQ(fragments.size(), 2u);
    EXPECT_EQ(fragments[0].weight, 9);
    EXPECT_EQ(fragments[1].weight, 6);
    EXPECT_EQ(cell_fragments(sorted({3})).size(), 1u);
}

TEST(Fragments, are_split_by_a_cut_inside_a_cell_or_between_two) {
    for (const auto& [value, num_fragments] : {std::pair{0.5, 3u}, std::pair{2.0, 2u}}) {
        SortedPoints points = sorted({0, 4, 3.5, 1, 0.25});
        const auto [lower, upper] = split(cell_fragments(points), cut_at(value), {}, points);
        EXPECT_EQ(lower.size() + upper.size(), num_fragments);
        for (const double x : positions_in(lower, points)) EXPECT_LT(x, value);
        for (const double x : positions_in(upper, points)) EXPECT_GE(x, value);
        EXPECT_EQ(positions_in(lower, points).size() + positions_in(upper, points).size(), 5u);
    }
}

TEST(Fragments, of_points_at_a_cut_go_below_until_the_weight_due_there_is_reached) {
    // Ranks before this one hold `before` of the weight at the cut, of which 2 belong below.
    for (const auto& [before, num_below] :
         {std::pair{0.0, 2u}, std::pair{1.0, 1u}, std::pair{2.0, 0u}, std::pair{5.0, 0u}}) {
        SortedPoints points = sorted({0, 2, 2, 2, 4});
        Cut cut = cut_at(2);
        EXPECT_EQ(weight_at(cut, cell_fragments(points), points), 3);
        const auto [lower, upper] = split(cell_fragments(points), cut, {before, 2}, points);
        EXPECT_EQ(positions_in(lower, points).size(), 1 + num_below) << before;
        EXPECT_EQ(positions_in(upper, points).size(), 4 - num_below) << before;
    }
}

TEST(Fragments, write_their_part_in_the_order_points_had) {
    SortedPoints points = sorted({4, 0, 3, 1}, {1, 2, 4, 8});
    const auto [lower, upper] = split(cell_fragments(points), cut_at(2.5), {}, points);
    std::vector<Part> parts(4, -1);
    EXPECT_EQ(write_part(lower, 6, points, parts), 10);
    EXPECT_EQ(write_part(upper, 7, points, parts), 5);
    EXPECT_EQ(parts, (std::vector<Part>{7, 6, 7, 6}));
}

}  // namespace
}  // namespace rrcb
