#include "../support/mpi_handles.hpp"
#include "../zoltan/program.hpp"
#include "rebalances.hpp"

#include <gtest/gtest.h>

namespace rrcb::hard_test {
namespace {

using zoltan_test::Program;

TEST(CallbackRebalances, hold_what_they_held) {
    Program program;
    program.set({{"LB_METHOD", "RRCB"}, {"OBJ_WEIGHT_DIM", "1"}, {"KEEP_CUTS", "1"}});
    program.weights.assign(400, 1);
    expect_constant_resources([&](int step) {
        program.coordinates = moving_cloud(step);
        program.set("RCB_REUSE", step % 3 == 1 ? "1" : "0");
        program.set("RRCB_REFINE", step % 2 == 0 ? "TOLERANCE" : "EXACT");
        program.set("RETURN_LISTS", step % 4 == 0 ? "PARTS" : "ALL");
        EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    });
}

TEST(CallbackRebalances, of_handles_that_come_and_go_hold_what_they_held) {
    const auto partition_once = [] {
        Program program;
        scatter_points(program, 50);
        program.set("LB_METHOD", "RRCB");
        EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    };
    partition_once();
    const test::MpiHandles before = test::mpi_handles();
    for (int k = 0; k < 20; ++k) partition_once();
    EXPECT_EQ(test::mpi_handles(), before);
}

}  // namespace
}  // namespace rrcb::hard_test
