// Processor time of a step's own work.
#include "slope.hpp"
#include "step/work.hpp"

#include <gtest/gtest.h>
#include <mpi.h>
#include <mpm/simulation.hpp>

namespace mpm {
namespace {

/// Uses so much processor time, or more.
void work(double seconds) {
    WorkClock clock;
    clock.restart();
    do {
        clock.pause();
        clock.resume();
    } while (clock.seconds() < seconds);
}

TEST(WorkClock, leaves_out_its_pauses) {
    WorkClock all;
    WorkClock own;
    all.restart();
    own.restart();
    work(0.001);
    own.pause();
    work(0.01);
    own.resume();
    work(0.001);
    own.pause();
    all.pause();
    EXPECT_GE(own.seconds(), 0.002);
    EXPECT_LE(own.seconds(), all.seconds() - 0.01);
}

TEST(WorkSeconds, are_those_of_the_last_step) {
    Simulation simulation(test::slope_scene(22), MPI_COMM_WORLD);
    EXPECT_EQ(simulation.work_seconds(), 0);
    simulation.step();
    WorkClock whole;
    whole.restart();
    simulation.step();
    whole.pause();
    EXPECT_GT(simulation.work_seconds(), 0);
    EXPECT_LT(simulation.work_seconds(), whole.seconds());
}

}  // namespace
}  // namespace mpm
