// No call raises a floating-point exception, as programs may trap them: an invalid operation, a
// division by zero or an overflow.
#include "clouds_of_all_ranks.hpp"

#include <rrcb/cost.hpp>
#include <rrcb/rrcb.hpp>

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace rrcb {
namespace {

/// Expects of a scope that it raises none.
class Watch {
  public:
    explicit Watch(std::string what) : what_(std::move(what)) { std::feclearexcept(all); }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    ~Watch() { EXPECT_EQ(std::fetestexcept(all), 0) << what_; }

  private:
    static constexpr int all = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
    std::string what_;
};

struct Case {
    std::string name;
    Options options;
};

std::vector<Case> cases(int dimension) {
    std::vector<Case> all(9);
    all[0].name = "tolerance";
    all[1].name = "exact";
    all[1].options.refine = Refine::exact;
    all[2].name = "none";
    all[2].options.refine = Refine::none;
    all[3].name = "divide";
    all[3].options.refine = Refine::exact;
    all[3].options.coincident = Coincident::divide;
    all[4].name = "plain";
    all[4].options.axes.plain = true;
    all[5].name = "grid";
    all[5].options.axes.grid.assign(static_cast<std::size_t>(dimension), {0.1, 0.01});
    all[6].name = "min_width";
    all[6].options.axes.min_width.assign(static_cast<std::size_t>(dimension), 0.01);
    all[7].name = "spread";
    all[7].options.tuning.central_parts = 2;
    all[8].name = "unequal parts";
    for (int part = 0; part < test::num_ranks(); ++part)
        all[8].options.part_sizes.push_back(part % 3);
    if (test::num_ranks() == 1) all[8].options.part_sizes = {1};
    return all;
}

/// Points crowd to one corner, lie in a few places, are few, or reach the ends of a double's range.
std::vector<std::vector<double>> clouds(int dimension) {
    const auto crowd = [](std::size_t, int axis, double u) { return std::pow(u, 1 + axis); };
    const auto places = [](std::size_t, int, double u) { return std::floor(4 * u) / 4; };
    const auto ends = [](std::size_t i, int, double u) {
        return std::ldexp(2 * u - 1, i % 2 == 0 ? 1024 : -1060);
    };
    return {test::share_of_cloud(3000, dimension, crowd),
            test::share_of_cloud(300, dimension, places), test::share_of_cloud(2, dimension, crowd),
            test::share_of_cloud(300, dimension, ends)};
}

TEST(Exceptions, are_raised_by_no_call) {
    for (const int dimension : {1, 2, 3}) {
        const auto all = clouds(dimension);
        for (const std::vector<double>& coordinates : all) {
            const Points points = interleaved_points(coordinates, dimension);
            std::vector<double> moved = coordinates;
            for (double& x : moved) x -= 0.03 * x;
            for (const auto& [name, options] : cases(dimension)) {
                // The lines of this grid are too close for such coordinates.
                if (name == "grid" && &coordinates == &all.back()) continue;
                const std::string where = name + " in " + std::to_string(dimension) + "-D";
                Balance first;
                {
                    const Watch watch("balance, " + where);
                    first = balance(points, options, {}, MPI_COMM_WORLD);
                }
                {
                    const Watch watch("balance from cuts, " + where);
                    balance(points, options, first.cuts, MPI_COMM_WORLD);
                    balance(interleaved_points(moved, dimension), options, first.cuts,
                            MPI_COMM_WORLD);
                }
                const Watch watch("lists, " + where);
                const Plan moves = plan(first, MPI_COMM_WORLD);
                const auto mine = transfer(moves, column(coordinates, dimension), MPI_COMM_WORLD);
                const GhostPlan near = ghosts(first.cuts, interleaved_points(mine, dimension),
                                              {.radius = 0.1}, MPI_COMM_WORLD);
                fetch(near, column(mine, dimension), MPI_COMM_WORLD);
                assign_all(first.cuts, points, MPI_COMM_WORLD);
                parts_touching(first.cuts, box_of(first.cuts, 0));
            }
        }
    }
}

TEST(Exceptions, are_raised_by_no_bad_input) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::signaling_NaN(), infinity}) {
        const std::vector<double> coordinates{0.5, bad, 0.25};
        const Points points = interleaved_points(coordinates, 1);
        Options options;
        const Watch watch("bad input");
        EXPECT_THROW(balance(points, options, {}, MPI_COMM_WORLD), Error);
        EXPECT_THROW(assign_all(Cuts{1, 1, {}, {}}, points, MPI_COMM_WORLD), Error);
        options.imbalance_tolerance = bad;
        EXPECT_THROW(balance({}, options, {}, MPI_COMM_WORLD), Error);
    }
}

TEST(Exceptions, are_raised_by_neither_controller_nor_cost_model) {
    const Watch watch("loop");
    Controller controller(MPI_COMM_WORLD);
    CostModel model(controller, 2);
    for (int step = 0; step < 50; ++step) {
        model.step(step % 5 == 0 ? 0 : 1 + test::rank(), {{100.0 * test::rank(), 1.0 * step}});
        if (controller.due()) controller.rebalanced(0.5);
        model.weights({{1.0, 0.0, 1.0, 2.0}});
    }
}

}  // namespace
}  // namespace rrcb
