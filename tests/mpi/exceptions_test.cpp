// No call raises a floating-point exception, as programs may trap them: an invalid operation, a
// division by zero or an overflow. Most other tests trap them as well (support/mpi_main.cpp).
#include "../support/common.hpp"
#include "ranks.hpp"

#include <rrcb/experimental/cost.hpp>
#include <rrcb/rrcb.hpp>

#include <cfenv>

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

TEST(Exceptions, are_raised_by_no_bad_input) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::signaling_NaN(), infinity}) {
        const std::vector<double> coordinates{0.5, bad, 0.25};
        const Points points(coordinates, 1);
        Options options;
        const Watch watch("bad input");
        EXPECT_THROW(balance(points, MPI_COMM_WORLD, options), Error);
        EXPECT_THROW(assign(Cuts{1, 1, {}, {}}, points, MPI_COMM_WORLD), Error);
        options.imbalance_tolerance = bad;
        EXPECT_THROW(balance({}, MPI_COMM_WORLD, options), Error);
    }
}

TEST(Exceptions, are_raised_by_neither_controller_nor_cost_model) {
    const Watch watch("loop");
    Controller controller(MPI_COMM_WORLD);
    experimental::CostModel model(controller, 2);
    for (int step = 0; step < 50; ++step) {
        model.step(step % 5 == 0 ? 0 : 1 + rank(), {{100.0 * rank(), 1.0 * step}});
        if (controller.due()) controller.rebalanced({.cost = 0.5});
        model.weights({{1.0, 0.0, 1.0, 2.0}});
    }
}

}  // namespace
}  // namespace rrcb
