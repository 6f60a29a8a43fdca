// Axes of the cuts that many ranks make.
#include "clouds_of_all_ranks.hpp"

#include <rrcb/balance.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

namespace rrcb {
namespace {

constexpr std::size_t num_points = 20000;

/// A layer of 3 % of the side of a square or cube, under drops: one point in 200.
std::vector<double> drops(int dimension) {
    return test::share_of_cloud(num_points, dimension, [&](std::size_t i, int axis, double u) {
        return axis == dimension - 1 && i % 200 != 0 ? 0.03 * u : u;
    });
}

Balance balance_by(const AxisOrder& order, int central_parts, int dimension) {
    Options options;
    options.num_parts = 16;
    options.expert.axes.order = order;
    options.expert.max_root_parts = central_parts;
    const std::vector<double> mine = drops(dimension);
    return balance(Points(mine, dimension), MPI_COMM_WORLD, options);
}

/// Points with another part within about three spacings of the layer.
int num_ghosts(const Cuts& cuts) {
    const int dimension = cuts.dimension;
    const double radius = 3 * std::pow(0.03 / num_points, 1.0 / dimension);
    const std::vector<double> mine = drops(dimension);
    const Points points(mine, dimension);
    int number = 0;
    for (LocalIndex i = 0; i < points.count; ++i) {
        const Vector x = points.position(i);
        bool is_near = false;
        for (int a = 0; a < dimension; ++a)
            for (const double step : {-radius, radius}) {
                Vector y = x;
                y[a] += step;
                is_near = is_near || part_of(cuts, y) != part_of(cuts, x);
            }
        number += is_near ? 1 : 0;
    }
    MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return number;
}

std::set<int> axes_of(const Cuts& cuts) {
    std::set<int> axes;
    for (const Cut& cut : cuts.tree) axes.insert(cut.axis);
    return axes;
}

TEST(SpreadAxes, leave_as_few_ghosts_as_those_of_rank_0) {
    for (const int dimension : {2, 3}) {
        const Balance central = balance_by({}, 16, dimension);
        const Balance spread = balance_by({}, 2, dimension);
        EXPECT_LE(num_ghosts(spread.cuts), 1.1 * num_ghosts(central.cuts)) << dimension << "-D";
        EXPECT_LE(spread.report.imbalance, 1.01);
    }
}

TEST(SpreadAxes, are_those_that_the_order_allows) {
    EXPECT_EQ(axes_of(balance_by({}, 2, 3).cuts), (std::set{0, 1}));
    EXPECT_EQ(axes_of(balance_by(AxisOrder::longest(), 2, 3).cuts), (std::set{0, 1, 2}));
    EXPECT_EQ(axes_of(balance_by(AxisOrder::among({2}), 2, 3).cuts), (std::set{2}));
    EXPECT_EQ(axes_of(balance_by(AxisOrder::among({2, 1}), 2, 3).cuts), (std::set{1}));
}

}  // namespace
}  // namespace rrcb
