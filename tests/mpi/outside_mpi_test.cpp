// Calls before MPI_Init and after MPI_Finalize are errors, in C as well.
#include "../support/common.hpp"
#include "c/for_fortran.h"

#include <rrcb/experimental/cost.hpp>
#include <rrcb/rrcb.h>
#include <rrcb/rrcb.hpp>

namespace rrcb {
namespace {

const std::string text = "MPI is not running; call after MPI_Init and before MPI_Finalize";

template <class Call>
void expect_error(Call&& call) {
    try {
        call();
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
        EXPECT_EQ(error.what(), text);
    }
}

void expect_errors() {
    const std::vector<double> x{0, 1};
    const Points points(x, 1);
    expect_error([&] { balance(points, MPI_COMM_WORLD); });
    expect_error([&] { (void)plan(std::vector<Part>(2), 1, MPI_COMM_WORLD); });
    expect_error([&] { release_buffers(MPI_COMM_WORLD); });
    expect_error([&] { Controller controller(MPI_COMM_WORLD); });
    expect_error([&] { experimental::CostModel model(MPI_COMM_WORLD, 2); });
    rrcb_balancer* balancer = nullptr;
    EXPECT_EQ(rrcb_balancer_create(MPI_COMM_WORLD, &balancer), RRCB_INVALID_ARGUMENT);
    EXPECT_EQ(rrcb_last_error(), text);
    rrcb_controller* controller = nullptr;
    EXPECT_EQ(rrcb_controller_create_fortran(0, &controller), RRCB_INVALID_ARGUMENT);
    EXPECT_EQ(rrcb_last_error(), text);
}

TEST(OutsideMpi, calls_are_errors) {
    expect_errors();
    MPI_Init(nullptr, nullptr);
    std::optional<Controller> controller(MPI_COMM_WORLD);
    std::optional<experimental::CostModel> model(std::in_place, MPI_COMM_WORLD, 1);
    controller->step({.load = 1});
    model->step(1, {{1.0}});
    rrcb_balancer* balancer = nullptr;
    ASSERT_EQ(rrcb_balancer_create(MPI_COMM_WORLD, &balancer), RRCB_OK);
    MPI_Finalize();
    expect_errors();
    expect_error([&] { controller->step({.load = 1}); });
    expect_error([&] { model->step(1, {{1.0}}); });
    const double x = 0;
    int32_t part = 0;
    const rrcb_points points = rrcb_interleaved_points(RRCB_DOUBLE, 1, 1, &x, nullptr);
    EXPECT_EQ(rrcb_balance(balancer, &points, &part), RRCB_INVALID_ARGUMENT);
    EXPECT_EQ(rrcb_last_error(), text);
    rrcb_balancer_destroy(&balancer);
}

}  // namespace
}  // namespace rrcb
