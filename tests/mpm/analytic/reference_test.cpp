#include "support.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mpm::test {
namespace {

constexpr double g = 9.81;

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

TEST(Effects, that_are_named_twice_or_not_there_are_refused) {
    Scene scene = in_water(2000);
    scene.effects.push_back(gravity_effect(g));
    EXPECT_THROW(validate(scene), std::invalid_argument);
    scene.effects.back().name = "levity";
    EXPECT_THROW(validate(scene), std::invalid_argument);
}

}  // namespace
}  // namespace mpm::test
