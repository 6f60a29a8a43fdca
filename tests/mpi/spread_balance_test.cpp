// Parts that many ranks make, see ExpertOptions::max_root_parts.
#include "../support/same_error.hpp"
#include "clouds_of_all_ranks.hpp"
#include "spread_checks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace rrcb {
namespace {

using test::expect_consistent;
using test::num_ranks;
using test::rank;
using test::share_of_cloud;

using Coordinate = std::function<double(std::size_t i, int axis, double u)>;

double uniform(std::size_t, int, double u) {
    return u;
}

Options spread_options(int central_parts, Refine refine = Refine::exact) {
    Options options;
    options.expert.max_root_parts = central_parts;
    options.refine = refine;
    return options;
}

/// Numbers of parts that rank 0 makes, on so many ranks that others make parts as well.
std::vector<int> central_parts() {
    std::vector<int> numbers;
    for (const int number : {2, 3, 4, 8})
        if (number < num_ranks()) numbers.push_back(number);
    return numbers;
}

TEST(SpreadBalance, tolerance_is_met_and_measured) {
    for (const double tolerance : {1.1, 1.02})
        for (const int central : central_parts())
            for (const int per_rank : {1, 3}) {
                const auto mine =
                    share_of_cloud(20000, 2, [](std::size_t, int, double u) { return u * u; });
                const Points points(mine, 2);
                Options options = spread_options(central, Refine::tolerance);
                options.imbalance_tolerance = tolerance;
                options.num_parts = per_rank * num_ranks();
                const Balance result = balance(points, MPI_COMM_WORLD, options);
                const auto weights = expect_consistent(points, result);
                EXPECT_LE(imbalance(weights), tolerance);
                EXPECT_TRUE(result.report.within_tolerance);
                EXPECT_NEAR(result.report.imbalance, imbalance(weights), 1e-12);
                EXPECT_EQ(result.report.details.num_points, 20000);
            }
}

TEST(SpreadBalance, a_tolerance_that_exact_cuts_reach_is_not_missed) {
    // So few points a part that slack spent above leaves too little below.
    for (const int central : central_parts())
        for (const int count : {25 * num_ranks(), 50 * num_ranks(), 50 * num_ranks() + 1}) {
            const auto mine = share_of_cloud(static_cast<std::size_t>(count), 2, uniform);
            std::vector<double> weights;
            for (std::size_t i = 0; i < mine.size(); i += 2)
                weights.push_back(0.5 + mine[i] * mine[i + 1]);
            const Points points(mine, 2, weights);
            const Balance exact = balance(points, MPI_COMM_WORLD, spread_options(central));
            Options options = spread_options(central, Refine::tolerance);
            options.imbalance_tolerance = exact.report.imbalance;
            const Balance result = balance(points, MPI_COMM_WORLD, options);
            expect_consistent(points, result);
            EXPECT_TRUE(result.report.within_tolerance) << central << ", " << count;
        }
}

TEST(SpreadBalance, a_small_part_gets_no_point_that_another_has_more_room_for) {
    // 10 points for each part but the first two, which share 10: 1.6 and 8.4 of them. With 2 points
    // the first would have 1.25 times its own; with 1 the second has 9, 1.07 times.
    const int count = 10 * (num_ranks() - 1);
    std::vector<double> sizes{1.6, 8.4};
    sizes.resize(static_cast<std::size_t>(num_ranks()), 10);
    for (const int central : central_parts())
        for (const bool is_weighted : {false, true}) {
            const auto mine = share_of_cloud(static_cast<std::size_t>(count), 1, uniform);
            std::vector<double> weights(mine.size(), 1.0);
            if (is_weighted && !weights.empty()) weights[0] = 1 + 1e-9;
            const Points points(mine, 1, weights);
            Options options = spread_options(central, Refine::tolerance);
            options.part_sizes = sizes;
            options.imbalance_tolerance = 1.2;
            const Balance result = balance(points, MPI_COMM_WORLD, options);
            const auto sums = expect_consistent(points, result);
            EXPECT_LE(imbalance(sums, sizes), 1.2) << central;
            EXPECT_TRUE(result.report.within_tolerance);
        }
}

void expect_axes(const Cuts& cuts, const std::vector<int>& cut_axes) {
    for (std::size_t k = 0; k < cuts.tree.size(); ++k) EXPECT_EQ(cuts.tree[k].axis, cut_axes[k]);
}

TEST(SpreadBalance, cuts_lie_across_the_axes_given_to_them) {
    const auto mine = share_of_cloud(2048, 3, uniform);
    const Points points(mine, 3);
    for (const Refine refine : {Refine::exact, Refine::tolerance})
        for (const int central : central_parts()) {
            Options options = spread_options(central, refine);
            options.imbalance_tolerance = 1.05;
            const Balance free = balance(points, MPI_COMM_WORLD, options);
            std::vector<int> axes;
            for (int node = 0; node + 1 < num_ranks(); ++node)
                axes.push_back((node * node + 1) % 3);
            options.expert.axes.order = AxisOrder::given(axes);
            const Balance result = balance(points, MPI_COMM_WORLD, options);
            EXPECT_LE(imbalance(expect_consistent(points, result)), 1.05);
            expect_axes(result.cuts, axes);
            // Cuts across other axes are made anew.
            const Balance again = balance(points, MPI_COMM_WORLD, options, free.cuts);
            expect_axes(again.cuts, axes);
            EXPECT_EQ(again.parts, result.parts);
            if (refine != Refine::exact) continue;
            options.expert.max_root_parts = num_ranks();
            EXPECT_EQ(result.parts, balance(points, MPI_COMM_WORLD, options).parts);
        }
}

TEST(SpreadBalance, points_in_one_place_are_divided_on_request_those_of_lower_ranks_below) {
    // All in one place; or in so few that cuts divide some.
    for (const double places : {1.0, 3.0, 40.0})
        for (const int central : central_parts()) {
            const auto mine = share_of_cloud(
                600, 2, [&](std::size_t, int, double u) { return std::floor(u * places); });
            const Points points(mine, 2);
            Options options = spread_options(central);
            options.expert.coincident = Coincident::divide;
            options.refine = Refine::tolerance;
            options.imbalance_tolerance = 1.05;
            const Balance good = balance(points, MPI_COMM_WORLD, options);
            EXPECT_LE(imbalance(part_weights(points, good.parts, num_ranks(), MPI_COMM_WORLD)),
                      1.05);
            options.refine = Refine::exact;
            const Balance result = balance(points, MPI_COMM_WORLD, options);
            test::expect_same_cuts_on_all_ranks(result.cuts);
            const auto weights = part_weights(points, result.parts, num_ranks(), MPI_COMM_WORLD);
            for (const double weight : weights)
                EXPECT_LE(std::abs(weight - 600.0 / num_ranks()), 2.5);
            EXPECT_NEAR(result.report.imbalance, imbalance(weights), 1e-12);
            if (places > 1) continue;
            // One row of all points: parts ascend along it.
            int ends[2] = {num_ranks(), -1};
            for (const Part part : result.parts) {
                ends[0] = std::min(ends[0], part);
                ends[1] = std::max(ends[1], part);
            }
            std::vector<int> all(static_cast<std::size_t>(2 * num_ranks()));
            MPI_Allgather(ends, 2, MPI_INT, all.data(), 2, MPI_INT, MPI_COMM_WORLD);
            EXPECT_TRUE(std::ranges::is_sorted(all));
        }
}

TEST(SpreadBalance, there_may_be_fewer_points_than_parts_and_none_at_all) {
    for (const std::size_t count : {0U, 1U, 3U}) {
        const auto mine = share_of_cloud(count, 2, uniform);
        const Points points(mine, 2);
        const Balance result = balance(points, MPI_COMM_WORLD, spread_options(2));
        const auto weights = expect_consistent(points, result);
        EXPECT_EQ(std::accumulate(weights.begin(), weights.end(), 0.0), count);
        EXPECT_LE(*std::ranges::max_element(weights), count == 3 && num_ranks() == 3 ? 2 : 1);
        EXPECT_EQ(result.report.details.num_empty_parts,
                  std::max(0, num_ranks() - static_cast<int>(count)));
    }
}

TEST(SpreadBalance, points_in_a_divided_place_are_looked_up_on_every_rank) {
    const auto mine =
        share_of_cloud(600, 2, [](std::size_t, int, double u) { return std::floor(3 * u); });
    const Points points(mine, 2);
    for (const Refine refine : {Refine::exact, Refine::tolerance}) {
        Options options = spread_options(2, refine);
        options.num_parts = 3 * num_ranks();
        options.expert.coincident = Coincident::divide;
        const Balance result = balance(points, MPI_COMM_WORLD, options);
        EXPECT_GT(result.report.details.coincident_cuts, 0);
        test::expect_same_cuts_on_all_ranks(result.cuts);
        std::vector<Part> parts(points.count);
        assign(result.cuts, points, parts);
        for (LocalIndex i = 0; i < points.count; ++i)
            EXPECT_EQ(parts[i], part_of(result.cuts, points.position(i)));
    }
}

TEST(SpreadBalance, what_is_wrong_on_one_rank_is_told_to_all) {
    std::vector<double> mine = share_of_cloud(1000, 2, uniform);
    const Points points(mine, 2);
    for (const int faulty : {0, num_ranks() - 1}) {
        Options options = spread_options(2);
        if (rank() == faulty) options.expert.max_root_parts = 1;
        test::expect_same_error(
            [&] { balance(points, MPI_COMM_WORLD, options); },
            "rank " + std::to_string(faulty) + ": max_root_parts must be at least 2");
        options.expert.max_root_parts = rank() == faulty ? 2 : 1000;
        test::expect_same_error([&] { balance(points, MPI_COMM_WORLD, options); },
                                "max_root_parts differs between rank");
    }
    const std::vector<double> fine{0.5, 1.5};
    EXPECT_EQ(balance(Points(fine, 1), MPI_COMM_WORLD).parts.size(), 2u);
}

}  // namespace
}  // namespace rrcb
