// Points that each rank holds by the last call: they come to rest.
#include "held_points.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rrcb {
namespace {

using test::balance_and_move;
using test::HeldPoints;
using test::num_ranks;
using test::Step;

Options with(Refine refine, int support_mesh = 0) {
    Options options;
    options.refine = refine;
    options.support_mesh = support_mesh;
    return options;
}

double imbalance_of(const HeldPoints& all, const Options& options) {
    std::vector<double> weights(static_cast<std::size_t>(num_ranks()));
    for (std::size_t i = 0; i < all.count(); ++i)
        weights[static_cast<std::size_t>(all.owners[i])] +=
            all.weights.empty() ? 1 : all.weights[i];
    return imbalance(weights, options.part_sizes);
}

/// Calls until nothing moves, thrice in a row; then again. Each move makes the imbalance less.
void expect_rest(HeldPoints all, const Options& options, int most_moves) {
    balance_and_move(all, options);
    double before = imbalance_of(all, options);
    int num_moves = 1;
    for (int call = 2; call <= most_moves + 3; ++call) {
        const Step step = balance_and_move(all, options);
        const double now = imbalance_of(all, options);
        if (step.num_moved > 0) {
            ++num_moves;
            EXPECT_LE(call, most_moves) << step.num_moved << " points";
            EXPECT_TRUE(now < before || options.refine == Refine::exact) << "call " << call;
        }
        if (step.balance.report.kept) {
            EXPECT_EQ(step.num_moved, 0u);
            EXPECT_EQ(step.balance.report.measured_imbalance, now);
        }
        EXPECT_EQ(step.num_strays, 0);
        before = now;
    }
}

TEST(PointsAtRest, of_a_slope_move_no_more_from_the_third_call_on) {
    for (const HeldPoints& slope : {test::lattice_slope(0.2121), test::random_slope(54464)})
        for (const int mesh : {0, 4, 8})
            for (const Refine refine :
                 {Refine::none, Refine::tolerance, Refine::automatic, Refine::exact}) {
                SCOPED_TRACE(std::to_string(slope.count()) + " points, mesh " +
                             std::to_string(mesh) + ", refine " +
                             std::to_string(static_cast<int>(refine)));
                expect_rest(slope, with(refine, mesh), 2);
            }
}

}  // namespace
}  // namespace rrcb
