#include "support.hpp"

#include <gtest/gtest.h>

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
            .effects = {gravity_effect(g), {"buoyancy", {{"water_density", 1000.0}}}}};
}

// Gravity acts on half of the mass, inertia on all of it.
TEST(FallingBody, falls_by_the_weight_that_buoyancy_leaves) {
    Simulation simulation(in_water(2000), MPI_COMM_WORLD);
    while (simulation.time() < 1) simulation.step();
    const Totals now = simulation.totals();
    EXPECT_NEAR(-now.momentum[1] / now.mass, g / 2 * simulation.time(), 1e-9);
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
