// Every stage of the search for one cut by itself, on histograms and candidates worked out by hand.
#include "../support/all_collected.hpp"
#include "arithmetic/quantum.hpp"
#include "cut_search_cases.hpp"

namespace rrcb {
namespace {

using test::infinity;
using test::layout;
using test::search_in;
using test::target_of;

constexpr double many = 5000;  // more than are gathered
constexpr double few = 1000;

/// A histogram of one axis with these weights and as many points in each slot.
std::vector<double> histogram_of(std::vector<double> weights, double count, double smallest = 0,
                                 double largest = 4) {
    std::vector<double> histogram = test::histogram_of(std::move(weights), count);
    histogram[0] = -smallest;
    histogram[max_dimension] = largest;
    return histogram;
}

const std::vector<double> slot_weights{2, 3, 5.25, 4, 1, 0};

TEST(CountInBins, ends_at_the_edge_that_is_near_enough) {
    CutSearch search = search_in(CutSearch::over_points);
    CutTarget target = target_of(10, 0.5);
    decide_by_bins(search, target, layout, histogram_of(slot_weights, many));
    EXPECT_EQ(search.stage, CutSearch::done);
    EXPECT_EQ(search.cut.at[0], 2);  // below it 2 + 3 + 5.25
    EXPECT_EQ(search.found_below, 10.25);

    search = search_in(CutSearch::over_points);
    target = target_of(5.25, 0.5);
    decide_by_bins(search, target, layout, histogram_of(slot_weights, many));
    EXPECT_EQ(search.cut.at[0], 1);  // the lower edge of the slot is nearer
    EXPECT_EQ(search.found_below, 5);
}

TEST(CountInBins, ends_at_once_where_nothing_belongs_below) {
    for (const auto stage : {CutSearch::over_points, CutSearch::over_candidates}) {
        CutSearch search = search_in(stage);
        CutTarget target = target_of(0);
        std::vector<double> histogram = histogram_of(slot_weights, many);
        histogram[layout.first_count()] = 0;
        decide_by_bins(search, target, layout, histogram);
        EXPECT_EQ(search.stage, CutSearch::done);
        EXPECT_EQ(search.cut.at[0], -infinity);
    }
}

TEST(CountInBins, goes_on_below_the_bracket_where_points_are_settled_there) {
    CutSearch search = search_in(CutSearch::over_points);
    CutTarget target = target_of(0);
    decide_by_bins(search, target, layout, histogram_of(slot_weights, many));
    EXPECT_EQ(search.stage, CutSearch::over_candidates);
    EXPECT_EQ(search.chosen, 0);
}

TEST(Narrow, goes_on_in_the_slot_of_the_target) {
    CutSearch search = search_in(CutSearch::over_points);
    CutTarget target = target_of(8);
    decide_by_bins(search, target, layout, histogram_of(slot_weights, many));
    EXPECT_EQ(search.stage, CutSearch::over_candidates);
    EXPECT_EQ(search.chosen, 2);
    EXPECT_EQ(search.lower, 1);
    EXPECT_EQ(search.upper, 2);
    EXPECT_EQ(search.by_bits, 0);
    EXPECT_EQ(target.weight_before, 5);
    EXPECT_EQ(target.num_candidates, 5000);
}

TEST(Narrow, reaches_to_the_outermost_point_beyond_the_bracket) {
    CutSearch search = search_in(CutSearch::over_points);
    CutTarget target = target_of(1);
    decide_by_bins(search, target, layout, histogram_of({2, 1}, many, -7, 9));
    EXPECT_EQ(search.chosen, 0);
    EXPECT_EQ(search.lower, -7);
    EXPECT_EQ(search.upper, 0);

    search = search_in(CutSearch::over_points);
    target = target_of(4);
    decide_by_bins(search, target, layout, histogram_of({2, 0, 0, 0, 0, 4}, many, -7, 9));
    EXPECT_EQ(search.chosen, 5);
    EXPECT_EQ(search.lower, 4);
    EXPECT_EQ(search.upper, std::nextafter(9.0, infinity));
}

TEST(Narrow, takes_bins_by_bits_where_bins_of_equal_width_do_not_help) {
    CutSearch search = search_in(CutSearch::over_candidates);
    CutTarget target = target_of(8);
    decide_by_bins(search, target, layout, histogram_of(slot_weights, many));
    EXPECT_EQ(search.stage, CutSearch::over_candidates);
    EXPECT_EQ(search.by_bits, 1);
}

TEST(Narrow, gathers_candidates_once_they_are_few) {
    CutSearch search = search_in(CutSearch::over_points);
    CutTarget target = target_of(8);
    decide_by_bins(search, target, layout, histogram_of(slot_weights, few));
    EXPECT_EQ(search.stage, CutSearch::gathering);
    EXPECT_EQ(target.num_candidates, 1000);
}

TEST(Tie, goes_on_along_the_next_axis) {
    CutSearch search = search_in(CutSearch::over_candidates, 2);
    CutTarget target = target_of(8, 0, 3);
    auto histogram = histogram_of({0, 0, 0, 10}, many, 2.5, 2.5);
    histogram[1] = 1;  // from -1 ...
    histogram[max_dimension + 1] = 6;
    decide_by_bins(search, target, layout, histogram);
    EXPECT_EQ(search.stage, CutSearch::over_candidates);
    EXPECT_EQ(search.tied, 1);
    EXPECT_EQ(search.cut.at[0], 2.5);
    EXPECT_EQ(search.lower, -1);
    EXPECT_EQ(search.upper, std::nextafter(6.0, infinity));
    EXPECT_EQ(target.weight_before, 3);
}

TEST(Tie, on_all_axes_leaves_the_points_on_the_nearer_side) {
    const auto histogram = histogram_of({0, 0, 0, 10}, many, 2.5, 2.5);
    for (const auto& [weight, at, below] :
         {std::tuple{7.0, 2.5, 3.0}, std::tuple{9.0, std::nextafter(2.5, infinity), 13.0}}) {
        CutSearch search = search_in(CutSearch::over_candidates);
        CutTarget target = target_of(weight, 0, 3);
        decide_by_bins(search, target, layout, histogram);
        EXPECT_EQ(search.stage, CutSearch::done);
        EXPECT_EQ(search.cut.at[0], at);
        EXPECT_EQ(search.found_below, below);
        EXPECT_EQ(search.coincident, 1);
        EXPECT_EQ(search.lot_below, 0);
    }
}

TEST(Tie, on_all_axes_divides_the_points_where_they_are_to_be_divided) {
    CutSearch search = search_in(CutSearch::over_candidates);
    CutTarget target = target_of(7, 0, 3);
    target.divides = true;
    decide_by_bins(search, target, layout, histogram_of({0, 0, 0, 10}, many, 2.5, 2.5));
    EXPECT_EQ(search.cut.at[0], 2.5);
    EXPECT_EQ(search.lot_below, 4);
    EXPECT_EQ(search.found_below, 3);
}

/// Ends among candidates of weight 1 on a line.
CutSearch search_among(const std::vector<double>& positions, CutTarget target,
                       bool divides = false) {
    CutSearch search = search_in(CutSearch::gathering);
    target.divides = divides;
    std::vector<double> records;
    for (const double x : positions) records.insert(records.end(), {x, 1});
    decide_among(search, target, records, 1);
    return search;
}

TEST(DecideAmong, cuts_halfway_between_two_candidates) {
    const CutSearch search = search_among({4, 1, 2}, target_of(12, 0, 10));
    EXPECT_EQ(search.stage, CutSearch::done);
    EXPECT_EQ(search.cut.at[0], 3);
    EXPECT_EQ(search.found_below, 12);
    EXPECT_EQ(search.coincident, 0);
}

TEST(DecideAmong, ends_at_the_ends_of_the_bracket_beyond_all_candidates) {
    EXPECT_EQ(search_among({1, 2}, target_of(10.25, 0, 10)).cut.at[0], 0);
    EXPECT_EQ(search_among({1, 2}, target_of(13, 0, 10)).cut.at[0], 4);
}

TEST(DecideAmong, keeps_candidates_in_one_place_together_or_divides_them) {
    const std::vector<double> positions{1, 2, 2, 2, 3};
    const CutSearch together = search_among(positions, target_of(2));
    EXPECT_EQ(together.coincident, 1);
    EXPECT_EQ(together.cut.at[0], 1.5);
    EXPECT_EQ(together.found_below, 1);
    const CutSearch divided = search_among(positions, target_of(2), true);
    EXPECT_EQ(divided.coincident, 1);
    EXPECT_EQ(divided.cut.at[0], 2);
    EXPECT_EQ(divided.lot_below, 1);
    EXPECT_EQ(divided.found_below, 1);
}

TEST(DecideAmong, breaks_ties_along_the_next_axis) {
    CutSearch search = search_in(CutSearch::gathering, 2);
    CutTarget target = target_of(1);
    decide_among(search, target, std::vector<double>{1, 7, 1, 1, 3, 1}, 2);
    EXPECT_EQ(search.cut.at[0], 1);
    EXPECT_EQ(search.cut.at[1], 5);
    EXPECT_EQ(search.found_below, 1);
}

TEST(Count, adds_up_points_and_settled_ones_and_keeps_those_of_a_slot) {
    const std::vector<double> x{0.5, 1.5, 1.25, 3.5};
    const std::vector<double> weights{1, 2, 3, 4};
    const Collected points = test::all_collected(Points(x, 1, weights));
    const auto counted = [&](const CutSearch& search, const Entries& entries) {
        std::vector<double> histogram(layout.length());
        clear_histogram(histogram);
        count(points, entries, 0, bins_of(search, layout), layout, histogram);
        return histogram;
    };
    const auto sums = [](const std::vector<double>& histogram) {
        return std::vector<double>(histogram.begin() + layout.num_extents, histogram.end());
    };
    const CutSearch before = search_in(CutSearch::over_points);
    std::vector<double> all = counted(before, {0, 1, 2, 3});
    EXPECT_EQ(sums(all), (std::vector<double>{0, 1, 5, 0, 4, 0, 0, 1, 2, 0, 1, 0}));
    EXPECT_EQ(all[0], -0.5);
    EXPECT_EQ(all[max_dimension], 3.5);
    Box box;
    box.lower[0] = -2;
    box.upper[0] = 9;
    count_settled({5, 2}, box, 0, layout, all);
    count_settled({0, 0}, box, 5, layout, all);
    EXPECT_EQ(sums(all), (std::vector<double>{5, 1, 5, 0, 4, 0, 2, 1, 2, 0, 1, 0}));
    EXPECT_EQ(all[0], 2);
    EXPECT_EQ(all[max_dimension], 9);

    CutSearch after = before;
    after.lower = 1;
    after.upper = 2;
    const Entries candidates = between(1, 2, 0, {0, 1, 2, 3}, points);
    EXPECT_EQ(candidates, (Entries{1, 2}));
    EXPECT_EQ(sums(counted(after, candidates)),
              (std::vector<double>{0, 0, 3, 2, 0, 0, 0, 0, 1, 1, 0, 0}));
}

}  // namespace
}  // namespace rrcb
