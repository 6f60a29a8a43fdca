// The edges of every stage of the search for one cut: where it may end and where it must go on.
#include "cut_search_cases.hpp"

namespace rrcb {
namespace {

using test::infinity;
using test::layout;
using test::search_in;
using test::target_of;

constexpr double largest = std::numeric_limits<double>::max();

/// Points at 1 ... 4 on all axes, 5000 in each slot: more than are gathered.
std::vector<double> histogram_of(std::vector<double> weights) {
    std::vector<double> histogram = test::histogram_of(std::move(weights), 5000);
    std::fill_n(histogram.begin(), max_dimension, -1);
    std::fill_n(histogram.begin() + max_dimension, max_dimension, 4);
    return histogram;
}

TEST(CountInBins, does_not_end_below_the_first_or_above_the_last_slot_which_have_no_edge_there) {
    CutSearch search = search_in(CutSearch::over_points);
    CutTarget target = target_of(0.25, 1);
    decide_by_bins(search, target, layout, histogram_of({3, 1}));
    EXPECT_EQ(search.stage, CutSearch::over_candidates);
    EXPECT_EQ(search.chosen, 0);

    search = search_in(CutSearch::over_points);
    target = target_of(3.75, 1);
    decide_by_bins(search, target, layout, histogram_of({1, 0, 0, 0, 0, 3}));
    EXPECT_EQ(search.stage, CutSearch::over_candidates);
    EXPECT_EQ(search.chosen, 5);
}

TEST(CountInBins, ends_before_empty_bins_where_the_target_is_reached) {
    CutSearch search = search_in(CutSearch::over_points);
    CutTarget target = target_of(5);
    decide_by_bins(search, target, layout, histogram_of({2, 3, 0, 0, 4}));
    EXPECT_EQ(search.stage, CutSearch::done);
    EXPECT_EQ(search.cut.at[0], 1);
}

TEST(CountInBins, ends_at_both_edges_of_the_bracket) {
    CutSearch search = search_in(CutSearch::over_points);
    CutTarget target = target_of(2.75, 0.25);
    decide_by_bins(search, target, layout, histogram_of({3, 1}));
    EXPECT_EQ(search.stage, CutSearch::done);
    EXPECT_EQ(search.cut.at[0], 0);
    EXPECT_EQ(search.found_below, 3);

    search = search_in(CutSearch::over_points);
    target = target_of(1.25, 0.25);
    decide_by_bins(search, target, layout, histogram_of({1, 0, 0, 0, 0, 3}));
    EXPECT_EQ(search.stage, CutSearch::done);
    EXPECT_EQ(search.cut.at[0], 4);
    EXPECT_EQ(search.found_below, 1);
}

TEST(CountInBins, counts_from_the_weight_known_below_the_bracket) {
    CutSearch search = search_in(CutSearch::over_candidates);
    CutTarget target = target_of(12, 0, 10);
    decide_by_bins(search, target, layout, histogram_of({0, 2, 3}));
    EXPECT_EQ(search.stage, CutSearch::done);
    EXPECT_EQ(search.cut.at[0], 1);
    EXPECT_EQ(search.found_below, 12);
}

TEST(CountInBins, ends_at_edges_of_equal_numbers_of_doubles) {
    CutSearch search = search_in(CutSearch::over_candidates);
    search.by_bits = 1;
    search.lower = 1;
    search.upper = 16;
    CutTarget target = target_of(5, 0);
    decide_by_bins(search, target, layout, histogram_of({0, 2, 3, 4, 1}));
    EXPECT_EQ(search.cut.at[0], 4);
}

TEST(CountInBins, of_a_later_axis_moves_that_axis_alone) {
    CutSearch search = search_in(CutSearch::over_candidates, 3);
    search.cut.axis = 1;
    search.cut.at[1] = 7;
    search.tied = 1;  // along axis 0
    CutTarget target = target_of(5, 0);
    decide_by_bins(search, target, layout, histogram_of({0, 2, 3, 4, 1}));
    EXPECT_EQ(search.cut.at, (Vector{2, 7, -infinity}));
}

TEST(Tie, of_many_candidates_in_one_double_is_broken_without_another_count) {
    CutSearch search = search_in(CutSearch::over_candidates, 2);
    search.by_bits = 1;
    search.lower = 1;
    search.upper = 1 + 4 * 0x1p-52;  // four doubles, one in each bin
    CutTarget target = target_of(8);
    auto histogram = histogram_of({0, 2, 10, 2});
    histogram[0] = -1;
    histogram[max_dimension] = 2;
    histogram[1] = -5;
    histogram[max_dimension + 1] = 6;
    decide_by_bins(search, target, layout, histogram);
    EXPECT_EQ(search.stage, CutSearch::over_candidates);
    EXPECT_EQ(search.chosen, 2);
    EXPECT_EQ(search.tied, 1);
    EXPECT_EQ(search.by_bits, 0);
    EXPECT_EQ(search.cut.at[0], 1 + 0x1p-52);
    EXPECT_EQ(search.lower, 5);
    EXPECT_EQ(search.upper, std::nextafter(6.0, infinity));
    EXPECT_EQ(target.weight_before, 2);
}

TEST(Tie, of_all_points_is_none_as_boxes_only_enclose_the_settled_ones) {
    CutSearch search = search_in(CutSearch::over_points, 2);
    CutTarget target = target_of(8);
    auto histogram = histogram_of({0, 10});
    histogram[0] = -0.5;
    histogram[max_dimension] = 0.5;
    decide_by_bins(search, target, layout, histogram);
    EXPECT_EQ(search.stage, CutSearch::over_candidates);
    EXPECT_EQ(search.tied, 0);
}

/// Ends among candidates, which `records` holds by position and weight.
CutSearch search_among(const std::vector<double>& records, CutTarget target) {
    CutSearch search = search_in(CutSearch::gathering);
    decide_among(search, target, records, 1);
    return search;
}

TEST(DecideAmong, weighs_candidates) {
    const std::vector<double> records{3, 1, 1, 6, 2, 2};  // in ascending order 6, 2, 1
    EXPECT_EQ(search_among(records, target_of(6.9)).cut.at[0], 1.5);
    EXPECT_EQ(search_among(records, target_of(7.1)).cut.at[0], 2.5);
    EXPECT_EQ(search_among(records, target_of(7.1)).found_below, 8);
}

TEST(DecideAmong, finds_a_value_between_the_outermost_and_the_nearest_doubles) {
    EXPECT_EQ(search_among({-largest, 1, largest, 1}, target_of(1)).cut.at[0], 0);
    EXPECT_LT(search_among({largest / 2, 1, largest, 1}, target_of(1)).cut.at[0], largest);
    const double next = std::nextafter(1.0, infinity);
    EXPECT_EQ(search_among({1, 1, next, 1}, target_of(1)).cut.at[0], next);
    EXPECT_EQ(search_among({0, 1, 5e-324, 1}, target_of(1)).cut.at[0], 5e-324);
}

TEST(DecideAmong, divides_no_lot_where_a_cut_beside_it_is_near_enough) {
    for (const auto& [slack, is_divided] : {std::pair{1.0, false}, std::pair{0.5, true}}) {
        CutSearch search = search_in(CutSearch::gathering);
        CutTarget target = target_of(2, slack);
        target.divides = true;
        decide_among(search, target, std::vector<double>{1, 1, 2, 1, 2, 1, 2, 1, 3, 1}, 1);
        EXPECT_EQ(search.coincident, 1);
        EXPECT_EQ(search.lot_below > 0, is_divided);
        EXPECT_EQ(search.found_below, 1);
    }
}

}  // namespace
}  // namespace rrcb
