// Fewer points than parts, or little more: the sharp bound of the imbalance, and ranks without
// points in all that follows a balance.
#include "../support/clouds.hpp"
#include "../support/ranks.hpp"

#include <rrcb/experimental/cost.hpp>
#include <rrcb/rrcb.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

/// Points of all ranks, dealt to the ranks at random.
struct FewPoints {
    std::vector<double> all;          ///< interleaved, 2-D
    std::vector<double> coordinates;  ///< of this rank
    std::vector<double> weights;      ///< of this rank

    explicit FewPoints(int count, bool is_skewed = false)
        : all(test::uniform_cloud(static_cast<std::size_t>(count), 2, 7)) {
        std::mt19937_64 engine(11);
        weights.reserve(1);
        for (std::size_t i = 0; i < all.size() / 2; ++i) {
            const double u = test::uniform(engine, 1e-3);
            if (static_cast<int>(engine() % static_cast<unsigned>(num_ranks())) != rank()) continue;
            coordinates.insert(coordinates.end(), {all[2 * i], all[2 * i + 1]});
            weights.push_back(is_skewed ? std::pow(u, -0.7) : 1);
        }
    }
    Points points() const { return Points(coordinates, 2, weights); }
};

/// Returns the least imbalance of all ways to give points of one weight to three parts.
double least_of_all(int count, const std::vector<double>& sizes) {
    double least = HUGE_VAL;
    for (int a = 0; a <= count; ++a)
        for (int b = 0; a + b <= count; ++b) {
            const std::vector<double> weights{1.0 * a, 1.0 * b, 1.0 * (count - a - b)};
            least = std::min(least, imbalance(weights, sizes));
        }
    return least;
}

TEST(FewPoints, have_the_least_imbalance_of_whole_points) {
    for (const int count : {1, 2, 15, 16, 17, 20, 39, 40, 1001}) {
        const FewPoints few(count);
        Options options;
        options.num_parts = 16;
        const Balance result = balance(few.points(), MPI_COMM_WORLD, options);
        EXPECT_DOUBLE_EQ(result.report.details.least_imbalance, (count + 15) / 16 * 16.0 / count);
        EXPECT_GE(result.report.imbalance, result.report.details.least_imbalance * (1 - 1e-12));
    }
    for (const std::vector<double>& sizes :
         {std::vector<double>{3, 1, 2}, {1, 0, 1}, {1, 10, 0.01}, {2, 2, 2}}) {
        for (const int count : {1, 2, 5, 7, 12}) {
            const FewPoints few(count);
            Options options;
            options.num_parts = 3;
            options.part_sizes = sizes;
            const Report report = balance(few.points(), MPI_COMM_WORLD, options).report;
            EXPECT_NEAR(report.details.least_imbalance, least_of_all(count, sizes), 1e-12) << count;
        }
    }
}

TEST(FewPoints, are_divided_by_the_first_cuts) {
    const FewPoints few(40);
    Options options;
    options.num_parts = 32;
    const Report report = balance(few.points(), MPI_COMM_WORLD, options).report;
    EXPECT_EQ(report.details.num_cells, 40) << "each is a cell of its own";
    EXPECT_EQ(report.imbalance, report.details.least_imbalance);
    EXPECT_EQ(report.details.rounds, 1) << "nothing is searched";
}

TEST(FewPoints, in_one_place_raise_the_imbalance_but_not_its_bound) {
    // 10 of 20 points at the origin.
    std::vector<double> mine;
    for (int i = rank(); i < 20; i += num_ranks()) mine.push_back(i < 10 ? 0 : i);
    for (const Refine refine : {Refine::tolerance, Refine::exact})
        for (const Coincident coincident : {Coincident::together, Coincident::divide}) {
            Options options;
            options.num_parts = 16;
            options.refine = refine;
            options.expert.coincident = coincident;
            const Report report = balance(Points(mine, 1), MPI_COMM_WORLD, options).report;
            const bool stay = coincident == Coincident::together;
            EXPECT_EQ(report.details.least_imbalance, 1.6);
            EXPECT_EQ(report.imbalance, stay ? 8 : 1.6);
            EXPECT_GT(report.details.coincident_cuts, 0);
        }
}

/// Pairs of all points within a distance.
int pairs_within(const std::vector<double>& all, double radius) {
    int pairs = 0;
    for (std::size_t i = 0; i < all.size(); i += 2)
        for (std::size_t j = 0; j < all.size(); j += 2)
            pairs += i != j && std::hypot(all[i] - all[j], all[i + 1] - all[j + 1]) <= radius;
    return pairs;
}

TEST(EmptyRanks, take_part_in_all_that_follows_a_balance) {
    for (const int count : {0, 1, 2, 39, 40}) {
        const FewPoints few(count);
        Options options;
        options.part_sizes.assign(static_cast<std::size_t>(num_ranks()), 0);
        std::fill_n(options.part_sizes.begin(), std::clamp(count / 10, 1, num_ranks()), 1);
        Controller controller(MPI_COMM_WORLD);
        experimental::CostModel model(controller, 1);
        const Balance result = balance(few.points(), MPI_COMM_WORLD, options);
        controller.rebalanced({.cost = 1, .report = &result.report});
        const std::vector<double> mine =
            transfer(plan(result, MPI_COMM_WORLD), column(few.coordinates, 2), MPI_COMM_WORLD);
        const Points points(mine, 2);
        const GhostPlan near = ghost_plan(result.cuts, points, MPI_COMM_WORLD, {.cutoff = 0.3});
        const std::vector<double> others = fetch(near, column(mine, 2), MPI_COMM_WORLD);
        int pairs = 0;
        for (std::size_t i = 0; i < mine.size(); i += 2)
            for (const auto* from : {&mine, &others})
                for (std::size_t j = 0; j < from->size(); j += 2)
                    pairs += !(from == &mine && i == j) &&
                             std::hypot(mine[i] - (*from)[j], mine[i + 1] - (*from)[j + 1]) <= 0.3;
        MPI_Allreduce(MPI_IN_PLACE, &pairs, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
        EXPECT_EQ(pairs, pairs_within(few.all, 0.3)) << count;
        const auto load = static_cast<double>(points.count);
        for (int step = 0; step < 20; ++step) {
            model.step(load, {{load}});
            // The points cannot be divided better.
            EXPECT_FALSE(controller.due()) << count << " points, step " << step;
        }
        EXPECT_EQ(model.weights(std::vector<double>(points.count, 1.0)).size(), points.count);
    }
}

}  // namespace
}  // namespace rrcb
