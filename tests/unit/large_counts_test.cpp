// More points than 32 bits count, told to the stages by numbers that no memory backs.
#include "estimate/cell_records.hpp"
#include "estimate/contribution.hpp"
#include "estimate/decision_mpi.hpp"

#include <rrcb/detail/bisection.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace rrcb {
namespace {

constexpr GlobalCount two_to_the_32 = GlobalCount{1} << 32;

/// Evenly spread points of weight 1 in a cell of length 1.
CellMoments unit_cell(LocalIndex number, GlobalCount count) {
    const auto lower = static_cast<double>(number);
    CellMoments cell;
    cell.cell = number;
    cell.box.lower = {lower, 0, 0};
    cell.box.upper = {lower + 1, 0, 0};
    cell.moments = {
        count, static_cast<double>(count), {lower + 0.5, 0, 0}, {1 / std::sqrt(12.0), 0, 0}};
    return cell;
}

TEST(LargeCounts, add_up_in_moments) {
    const Moments a{two_to_the_32, 0x1p32, {0, 0, 0}, {0, 0, 0}};
    const Moments b{two_to_the_32 * 3, 0x3p32, {4, 0, 0}, {0, 0, 0}};
    const Moments both = merge(a, b);
    EXPECT_EQ(both.count, two_to_the_32 * 4);
    EXPECT_EQ(both.weight, 0x1p34);
    EXPECT_DOUBLE_EQ(both.mean[0], 3);
    // A quarter lies 3 below the mean, the rest 1 above: (9 + 3) / 4.
    EXPECT_DOUBLE_EQ(both.deviation[0], std::sqrt(3.0));
}

TEST(LargeCounts, add_up_over_the_ranks) {
    Summary all;
    all.num_points = two_to_the_32 / 2 + 1;
    all.num_cells = 1;
    Summary next = all;
    next.first_rank = 1;
    join(all, next);
    join(all, next);
    EXPECT_EQ(all.num_points, two_to_the_32 / 2 * 3 + 3);
}

/// What the root hears of 2^34 points in two cells, three quarters of them in the first.
Contribution large_contribution(const Options& options) {
    Contribution all;
    Box& box = all.summary.box;
    box.lower = {0, 0, 0};
    box.upper = {2, 0, 0};
    const std::vector cells{unit_cell(0, two_to_the_32 * 3), unit_cell(1, two_to_the_32)};
    CellSet set;
    set.cells = cells;
    set.exponent = 0;
    append_cells(set, 1, 1, all.records);
    all.summary.request = request_of(options, 1, nullptr);
    all.summary.num_points = two_to_the_32 * 4;
    all.summary.num_cells = 2;
    all.summary.weight = 0x1p34;
    all.summary.lightest = all.summary.heaviest = 1;
    return all;
}

TEST(LargeCounts, are_divided_and_reported_by_the_root) {
    Options options{.num_parts = 2, .part_sizes = {1, 1}, .refine = Refine::none};
    Decision decision;
    make_buffers(decision, options, 1, false);
    decide(large_contribution(options), options, decision);
    // Half of the weight is two thirds of the first cell's.
    EXPECT_DOUBLE_EQ(decision.cuts.tree[0].at[0], 2.0 / 3);
    const Report report = report_of(decision.verdict, 2, options.part_sizes);
    EXPECT_EQ(report.details.num_points, two_to_the_32 * 4);
    EXPECT_EQ(report.details.total_weight, 0x1p34);
    EXPECT_EQ(report.details.least_imbalance, 1);
    EXPECT_EQ(report.details.num_empty_parts, 0);
    EXPECT_NEAR(report.details.estimated_imbalance, 1, 1e-15);
}

}  // namespace
}  // namespace rrcb
