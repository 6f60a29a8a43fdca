// A flow changes its shape: cuts that keep their axes become bad ones.
#include "../support/clouds.hpp"
#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

constexpr std::size_t num_points = 12000;

/// A column of 1 x 2 at time 0 that is a layer of 10 x 0.2 at time 1, and drops.
struct Flow {
    std::vector<double> start = test::uniform_cloud(num_points, 2, 21);
    double width = 1;
    double height = 2;

    void go_to(double time) {
        width = std::pow(10, time);
        height = 2 * std::pow(0.1, time);
    }
    Vector at(std::size_t i) const {
        return {width * start[2 * i], (i % 300 == 0 ? 2 : height) * start[2 * i + 1], 0};
    }
    std::vector<double> mine() const {
        std::vector<double> coordinates;
        for (auto i = static_cast<std::size_t>(rank()); i < num_points;
             i += static_cast<std::size_t>(num_ranks()))
            coordinates.insert(coordinates.end(), {at(i)[0], at(i)[1]});
        return coordinates;
    }
    /// Points with a part that is not theirs within two spacings.
    int num_ghosts(const Cuts& cuts) const {
        const double reach = 2 * std::sqrt(width * height / num_points);
        int number = 0;
        for (std::size_t i = 0; i < num_points; ++i) {
            const Vector x = at(i);
            bool is_near = false;
            for (const double dx : {-reach, reach})
                for (const double dy : {-reach, reach})
                    is_near = is_near || part_of(cuts, {x[0] + dx, x[1] + dy}) != part_of(cuts, x);
            number += is_near ? 1 : 0;
        }
        return number;
    }
};

std::vector<Part> parts_of(const Flow& flow, const Cuts& cuts) {
    std::vector<Part> parts;
    for (std::size_t i = 0; i < num_points; ++i) parts.push_back(part_of(cuts, flow.at(i)));
    return parts;
}

TEST(TurningAxes, follow_a_flow_and_move_few_points) {
    Flow flow;
    Options options;
    options.num_parts = 4;
    std::vector<double> mine = flow.mine();
    Balance balance = rrcb::balance(interleaved_points(mine, 2), options, {}, MPI_COMM_WORLD);
    EXPECT_GT(balance.report.details.near_after, 0);
    EXPECT_EQ(balance.report.details.near_before, 0);
    std::size_t num_moved = 0;
    for (int step = 1; step <= 100; ++step) {
        const std::vector<Part> before = parts_of(flow, balance.cuts);
        flow.go_to(step / 100.0);
        mine = flow.mine();
        const Points points = interleaved_points(mine, 2);
        balance = rrcb::balance(points, options, balance.cuts, MPI_COMM_WORLD);
        const std::vector<Part> after = parts_of(flow, balance.cuts);
        for (std::size_t i = 0; i < num_points; ++i) num_moved += before[i] != after[i];
        EXPECT_GT(balance.report.details.near_before, 0);
        EXPECT_TRUE(balance.report.within_tolerance);
        if (step % 10 != 0) continue;
        const Cuts anew = rrcb::balance(points, options, {}, MPI_COMM_WORLD).cuts;
        EXPECT_LE(flow.num_ghosts(balance.cuts), 1.15 * flow.num_ghosts(anew)) << step;
    }
    // Three quarters of the points change parts once.
    EXPECT_LT(num_moved, 1.1 * num_points);
    for (const Cut& cut : balance.cuts.tree) EXPECT_EQ(cut.axis, 0);
}

TEST(TurningAxes, are_kept_by_points_at_rest_and_on_request) {
    Flow flow;
    Options options;
    options.num_parts = 4;
    std::vector<double> mine = flow.mine();
    Balance balance = rrcb::balance(interleaved_points(mine, 2), options, {}, MPI_COMM_WORLD);
    const std::vector<Part> parts = parts_of(flow, balance.cuts);
    for (int call = 0; call < 5; ++call)
        balance = rrcb::balance(interleaved_points(mine, 2), options, balance.cuts, MPI_COMM_WORLD);
    EXPECT_EQ(parts_of(flow, balance.cuts), parts);
    flow.go_to(1);
    mine = flow.mine();
    Cuts kept = balance.cuts;
    kept.near = {};
    kept = rrcb::balance(interleaved_points(mine, 2), options, kept, MPI_COMM_WORLD).cuts;
    for (std::size_t k = 0; k < kept.tree.size(); ++k)
        EXPECT_EQ(kept.tree[k].axis, balance.cuts.tree[k].axis);
}

}  // namespace
}  // namespace rrcb
