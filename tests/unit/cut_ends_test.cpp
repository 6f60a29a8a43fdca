// The edges of every stage of the search for one cut: where it may end and where it must go on.
#include "cut_search_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

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
    CutSearch search = search_in(CutSearch::over_fragments);
    CutTarget target = target_of(0.25, 1);
    decide_by_bins(search, target, layout, histogram_of({3, 1}));
    EXPECT_EQ(search.stage, CutSearch::over_candidates);
    EXPECT_EQ(search.chosen, 0);

    search = search_in(CutSearch::over_fragments);
    target = target_of(3.75, 1);
    decide_by_bins(search, target, layout, histogram_of({1, 0, 0, 0, 0, 3}));
    EXPECT_EQ(search.stage, CutSearch::over_candidates);
    EXPECT_EQ(search.chosen, 5);
}

TEST(CountInBins, ends_before_empty_bins_where_the_target_is_reached) {
    CutSearch search = search_in(CutSearch::over_fragments);
    CutTarget target = target_of(5);
    decide_by_bins(search, target, layout, histogram_of({2, 3, 0, 0, 4}));
    EXPECT_EQ(search.stage, CutSearch::done);
    EXPECT_EQ(search.cut.at[0], 1);
}

TEST(CountInBins, ends_at_both_edges_of_the_bracket) {
    CutSearch search = search_in(CutSearch::over_fragments);
    CutTarget target = target_of(2.75, 0.25);
    decide_by_bins(search, target, layout, histogram_of({3, 1}));
    EXPECT_EQ(search.stage, CutSearch::done);
    EXPECT_EQ(search.cut.at[0], 0);
    EXPECT_EQ(search.below, 3);

    search = search_in(CutSearch::over_fragments);
    target = target_of(1.25, 0.25);
    decide_by_bins(search, target, layout, histogram_of({1, 0, 0, 0, 0, 3}));
    EXPECT_EQ(search.stage, CutSearch::done);
    EXPECT_EQ(search.cut.at[0], 4);
    EXPECT_EQ(search.below, 1);
}

TEST(CountInBins, counts_from_the_weight_known_below_the_bracket) {
    CutSearch search = search_in(CutSearch::over_candidates);
    CutTarget target = target_of(12, 0, 10);
    decide_by_bins(search, target, layout, histogram_of({0, 2, 3}));
    EXPECT_EQ(search.stage, CutSearch::done);
    EXPECT_EQ(search.cut.at[0], 1);
    EXPECT_EQ(search.below, 12);
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

TEST(Tie, samples_once_candidates_were_counted_four_times) {
    CutSearch search = search_in(CutSearch::over_candidates, 2);
    search.by_bits = 1;
    CutTarget target = target_of(8);
    target.num_counts = 3;
    auto histogram = histogram_of({10});
    histogram[0] = -2.5;
    histogram[max_dimension] = 2.5;
    decide_by_bins(search, target, layout, histogram);
    EXPECT_EQ(search.stage, CutSearch::sampling);
    EXPECT_EQ(search.tied, 1);
    EXPECT_EQ(search.by_bits, 0);
}

TEST(Tie, of_fragments_is_none_as_their_boxes_only_enclose_the_points) {
    CutSearch search = search_in(CutSearch::over_fragments, 2);
    CutTarget target = target_of(8);
    auto histogram = histogram_of({0, 10});
    histogram[0] = -0.5;
    histogram[max_dimension] = 0.5;
    decide_by_bins(search, target, layout, histogram);
    EXPECT_EQ(search.stage, CutSearch::over_candidates);
    EXPECT_EQ(search.tied, 0);
}

/// Below, at, between, at and above the splitters (2, 9) and (5, 1).
CutSearch search_by_splitters(double weight, CutTarget& target) {
    const std::vector<Vector> splitters{{2, 9}, {5, 1}};
    CutSearch search = search_in(CutSearch::over_splitters, 2);
    target = target_of(weight, 0.5);
    decide_by_splitters(search, target, layout, splitters, histogram_of({3, 2, 4, 2, 3}));
    return search;
}

TEST(CountBetweenSplitters, ends_at_a_splitter_on_all_axes_and_behind_it_on_the_last) {
    CutTarget target;
    const CutSearch at = search_by_splitters(8.75, target);
    EXPECT_EQ(at.cut.at, (Vector{5, 1, -infinity}));
    EXPECT_EQ(at.below, 9);
    const CutSearch behind = search_by_splitters(5.25, target);
    EXPECT_EQ(behind.cut.at, (Vector{2, std::nextafter(9.0, infinity), -infinity}));
    EXPECT_EQ(behind.below, 5);
}

TEST(CountBetweenSplitters, goes_on_at_its_ends_where_no_splitter_is) {
    CutTarget target;
    const CutSearch first = search_by_splitters(0.25, target);
    EXPECT_EQ(first.stage, CutSearch::sampling);
    EXPECT_EQ(first.chosen, 0);
    EXPECT_EQ(target.base, 0);
    const CutSearch last = search_by_splitters(13.75, target);
    EXPECT_EQ(last.stage, CutSearch::sampling);
    EXPECT_EQ(last.chosen, 4);
    EXPECT_EQ(target.base, 11);
}

/// Ends among candidates, which `records` holds by position and weight.
CutSearch search_among(const std::vector<double>& records, CutTarget target,
                       bool between_splitters = false) {
    CutSearch search = search_in(CutSearch::gathering);
    search.between_splitters = between_splitters ? 1 : 0;
    decide_among(search, target, records, 1);
    return search;
}

TEST(DecideAmong, weighs_candidates) {
    const std::vector<double> records{3, 1, 1, 6, 2, 2};  // in ascending order 6, 2, 1
    EXPECT_EQ(search_among(records, target_of(6.9)).cut.at[0], 1.5);
    EXPECT_EQ(search_among(records, target_of(7.1)).cut.at[0], 2.5);
    EXPECT_EQ(search_among(records, target_of(7.1)).below, 8);
}

TEST(DecideAmong, ends_at_the_outermost_candidates_between_splitters) {
    const std::vector<double> records{2, 1, 1, 1};
    EXPECT_EQ(search_among(records, target_of(10.25, 0, 10), true).cut.at[0], 1);
    EXPECT_EQ(search_among(records, target_of(13, 0, 10), true).cut.at[0],
              std::nextafter(2.0, infinity));
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
        search.divides = 1;
        CutTarget target = target_of(2, slack);
        decide_among(search, target, std::vector<double>{1, 1, 2, 1, 2, 1, 2, 1, 3, 1}, 1);
        EXPECT_EQ(search.coincident, 1);
        EXPECT_EQ(search.lot_below > 0, is_divided);
        EXPECT_EQ(search.below, is_divided ? 2 : 1);
    }
}

TEST(LocalSearch, counts_and_keeps_its_candidates_between_splitters) {
    std::vector<double> x(9);
    std::iota(x.begin(), x.end(), 0.0);
    const Points points = interleaved_points(x, 1);
    const SortedPoints sorted =
        sort_by_cell(bin_by_cell(points, make_support_mesh(bounding_box(points), 1, 3)));
    const std::vector<Fragment> fragments = cell_fragments(sorted);
    LocalSearch local(fragments, sorted);
    CutSearch all = search_in(CutSearch::over_fragments);
    CutSearch search = search_in(CutSearch::over_splitters);
    all.upper = 100;
    search.chosen = 1;  // all lie in the first bin of width 25
    local.keep_chosen(all, search, layout);
    local.take_splitters({{2}, {6}});
    std::vector<double> histogram(layout.length());
    clear_histogram(histogram);
    local.count(search, layout, histogram);
    EXPECT_EQ(std::vector<double>(histogram.begin() + layout.num_extents,
                                  histogram.begin() + layout.num_extents + 5),
              (std::vector<double>{2, 1, 3, 1, 2}));
    CutSearch after = search;
    after.chosen = 2;
    local.keep_chosen(search, after, layout);
    std::vector<double> records;
    local.append_candidates(records);
    EXPECT_EQ(records, (std::vector<double>{3, 1, 4, 1, 5, 1}));
}

}  // namespace
}  // namespace rrcb
