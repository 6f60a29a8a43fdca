#include "support.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mpm::test {
namespace {

constexpr double g = 9.81;

constexpr double slope_angle = 24 * std::numbers::pi / 180, ramp = 1;

/// A block on a plane inclined by 24 degrees: the plane is the bottom, gravity is inclined. It
/// grows in a second, so that the block does not bounce.
Scene incline(double friction) {
    return {.name = "incline",
            .grid = {.lower = {0, 0}, .spacing = 0.25, .num_cells = {96, 8}},
            .materials = {elastic_material("block", 1000, 1e6, 0.3)},
            .bodies = {{.contains = box_region({{0.5, 0}, {2.5, 1}}),
                        .points_per_cell = {2, 2, 1},
                        .material = "block"}},
            .walls = {.bottom = {Wall::frictional, friction}},
            .effects = {{"gravity",
                         {{"acceleration", std::vector<double>{g * std::sin(slope_angle),
                                                               -g * std::cos(slope_angle)}},
                          {"ramp", ramp}}}}};
}

double slide(const Scene& scene, double end_time) {
    Simulation simulation(scene, MPI_COMM_WORLD);
    const Totals start = simulation.totals();
    while (simulation.time() < end_time) simulation.step();
    const Totals end = simulation.totals();
    // To the very time, with the mean velocity.
    const double late = simulation.time() - end_time;
    return end.center[0] - start.center[0] - end.momentum[0] / end.mass * late;
}

// With gravity growing until T the distance is a (t^2 / 2 - T t / 2 + T^2 / 6).
TEST(Incline, block_slides_with_coulomb_friction) {
    const double friction = std::tan(std::numbers::pi / 12), t = 5;
    const double acceleration = g * (std::sin(slope_angle) - friction * std::cos(slope_angle));
    const double expected = acceleration * (t * t - ramp * t + ramp * ramp / 3) / 2;
    EXPECT_NEAR(slide(incline(friction), t), expected, 1e-3 * expected);
}

TEST(Incline, block_sticks_when_friction_is_above_the_slope) {
    // Sheared by its weight, rho g sin H / G over half its height, it leans by 5 mm.
    EXPECT_LT(slide(incline(std::tan(std::numbers::pi / 6)), 2), 0.01);
}

/// A square metre in water, 10 m above the bottom.
Scene in_water(double density) {
    return {.name = "falling",
            .grid = {.lower = {0, 0}, .spacing = 0.25, .num_cells = {12, 48}},
            .materials = {elastic_material("block", density, 1e6, 0.3)},
            .bodies = {{.contains = box_region({{1, 10}, {2, 11}}),
                        .points_per_cell = {2, 2, 1},
                        .material = "block"}},
            .effects = {gravity_effect(g),
                        {"buoyancy", {{"water_density", 1000.0}}},
                        {"water_drag", {{"water_density", 1000.0}, {"drag_coefficient", 1.0}}}}};
}

// m v' = W' - rho_w Cd A v^2 / 2: v_t tanh(t / tau), v_t = sqrt(2 W' / (rho_w Cd A)).
TEST(FallingBody, reaches_its_terminal_velocity) {
    Simulation simulation(in_water(2000), MPI_COMM_WORLD);
    const double weight = 1000 * g, terminal = std::sqrt(2 * weight / 1000);
    const double tau = 2000 * terminal / weight;
    while (simulation.time() < 2) {
        simulation.step();
        const Totals now = simulation.totals();
        EXPECT_NEAR(-now.momentum[1] / now.mass, terminal * std::tanh(simulation.time() / tau),
                    0.02 * terminal);
    }
}

TEST(FallingBody, that_is_neutrally_buoyant_stays) {
    Simulation simulation(in_water(1000), MPI_COMM_WORLD);
    for (int step = 0; step < 50; ++step) simulation.step();
    EXPECT_EQ(simulation.max_speed(), 0);
}

TEST(Effects, that_are_not_named_leave_no_trace) {
    Scene scene = in_water(2000);
    scene.effects.clear();
    const Simulation bare(scene, MPI_COMM_WORLD);
    EXPECT_EQ(bare.kernels(), (std::vector<std::string>{"p2g", "ghost_nodes", "move_nodes", "g2p",
                                                        "elastic", "migrate"}));
    EXPECT_EQ(bare.doubles_per_ghost_node(), 5u);
    EXPECT_EQ(bare.particles().column_names().size(), 11u);
    const Simulation full(in_water(2000), MPI_COMM_WORLD);
    EXPECT_EQ(full.doubles_per_ghost_node(), 9u);
    EXPECT_EQ(full.kernels(),
              (std::vector<std::string>{"p2g", "node_volume", "water_surface", "surface_area",
                                        "surface_area", "ghost_nodes", "gravity", "buoyancy",
                                        "water_drag", "move_nodes", "g2p", "water_surface",
                                        "elastic", "migrate"}));
}

TEST(Effects, that_are_named_twice_or_not_there_are_refused) {
    Scene scene = in_water(2000);
    scene.effects.push_back(gravity_effect(g));
    EXPECT_THROW(validate(scene), std::invalid_argument);
    scene.effects.back().name = "levity";
    EXPECT_THROW(validate(scene), std::invalid_argument);
}

}  // namespace
}  // namespace mpm::test
