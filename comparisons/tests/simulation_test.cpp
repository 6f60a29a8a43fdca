#include "balancer_mpi.hpp"
#include "simulation_mpi.hpp"

#include <rrcb/quality.hpp>

#include <gtest/gtest.h>
#include <mpm/slope.hpp>
#include <zoltan.h>

#include <stdexcept>

namespace comparisons {
namespace {

SimulationRun run(const std::optional<mpm::Balancer>& balancer) {
    float version = 0;
    Zoltan_Initialize(0, nullptr, &version);
    const SimulationPlan plan{
        .scene = mpm::slope_scene(22), .num_steps = 6, .every = 2, .record_every = 2};
    TimedSimulation simulation(
        plan, balancer, [](int, const mpm::Simulation&) {}, MPI_COMM_WORLD);
    simulation.advance(4);
    simulation.advance(4);
    return simulation.result();
}

int num_ranks() {
    int size = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return size;
}

TEST(Simulation, every_balancer_keeps_the_points_and_their_mass) {
    const SimulationRun slabs = run(std::nullopt);
    ASSERT_EQ(slabs.error, "");
    EXPECT_EQ(slabs.balance_s, 0);
    for (const char* name : {"zoltan-rcb", "root-rcb", "rrcb-sampled", "rrcb", "rrcb-exact"}) {
        const SimulationRun result = run(make_balancer(read_method(name)));
        ASSERT_EQ(result.error, "") << name;
        EXPECT_EQ(result.num_points, slabs.num_points) << name;
        EXPECT_NEAR(result.mass_kg, slabs.mass_kg, 1e-12 * slabs.mass_kg) << name;
        ASSERT_EQ(result.history.size(), 3U) << name;
        EXPECT_EQ(result.history[1].step, 2) << name;
    }
}

TEST(Simulation, exact_methods_share_the_points_out_to_one_a_level) {
    constexpr double levels = 2;  // of the bisection, up to 4 parts
    for (const char* name : {"zoltan-rcb", "root-rcb", "rrcb-exact"}) {
        const SimulationRun result = run(make_balancer(read_method(name)));
        ASSERT_EQ(result.error, "") << name;
        const double mean = static_cast<double>(result.num_points) / num_ranks();
        for (const LoadRecord& record : result.history) {
            for (const double points : record.points) EXPECT_NEAR(points, mean, levels) << name;
        }
        constexpr double steps = 6;
        EXPECT_NEAR(result.path_points, steps * mean, steps * levels) << name;
        EXPECT_GT(result.step_cost.path_s, 0) << name;
        EXPECT_LE(result.step_cost.path_s, result.step_cost.work_s) << name;
        EXPECT_GE(result.step_cost.path_s * num_ranks(), result.step_cost.work_s) << name;
    }
}

TEST(Simulation, methods_without_boxes_are_left_out) {
    EXPECT_FALSE(make_balancer(read_method("zoltan-rib")));
    EXPECT_FALSE(make_balancer(read_method("zoltan-hsfc")));
}

TEST(Simulation, a_balancer_that_fails_leaves_its_reason) {
    const mpm::Balancer broken = [](mpm::Positions, MPI_Comm) -> mpm::Decomposition {
        throw std::runtime_error("no balance today");
    };
    EXPECT_NE(run(broken).error.find("no balance today"), std::string::npos);
}

}  // namespace
}  // namespace comparisons
