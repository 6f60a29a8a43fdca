// The least mass of nodes goes by the points that touch them, not by the heaviest body of a scene.
#include "support.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mpm::test {
namespace {

/// A body of wave speed 10.
Material of_density(const std::string& name, double density) {
    return elastic_material(name, density, 100 * density, 0);
}

Body box_of(const std::string& material, double begin, double end) {
    return {.contains = box_region({{begin, 0}, {end, 1}}), .material = material};
}

/// A wave in 40 m of one density that meets 40 m of another, density 1, on request with the cure.
Scene wave_into_other(double density, ShapeFunction shape, bool has_cure) {
    Scene scene{.name = "wave",
                .grid = {.lower = {0, 0}, .spacing = 0.5, .num_cells = {164, 1}},
                .materials = {of_density("first", density), of_density("second", 1)},
                .bodies = {box_of("first", 0, 40), box_of("second", 40, 80)},
                .walls = {.left = Wall::roller, .bottom = Wall::roller, .top = Wall::roller},
                .shape_function = shape,
                .courant_number = shape == ShapeFunction::linear ? 0.25 : 0.1};
    scene.bodies.front().velocity = [](const Vector& at) {
        const double away = (at[0] - 20) / 7;
        return Vector{0.01 * std::exp(-away * away), 0, 0};
    };
    if (has_cure) scene.effects = {{"locking_cure", {}}};
    return scene;
}

/// Energies of two states with the strain energy at the time of the velocities, half a step back.
double energy_between(const Totals& before, const Totals& after) {
    return after.kinetic_energy + 0.5 * (before.strain_energy + after.strain_energy);
}

// The first wave has passed from one density to the other by then, and come back from the wall.
TEST(LeastMass, keeps_the_energy_of_waves_between_densities) {
    for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::quadratic})
        for (const auto& [density, has_cure] :
             {std::pair(0.01, true), std::pair(0.05, true), std::pair(0.3, false),
              std::pair(0.3, true), std::pair(1.0, true), std::pair(4.0, true),
              std::pair(20.0, false), std::pair(20.0, true), std::pair(100.0, true)}) {
            SCOPED_TRACE(density);
            Simulation simulation(wave_into_other(density, shape, has_cure), MPI_COMM_WORLD);
            const double start = simulation.totals().kinetic_energy;
            Totals before = simulation.totals(), after = before;
            while (simulation.time() < 5) {
                simulation.step();
                before = after;
                after = simulation.totals();
            }
            EXPECT_NEAR(energy_between(before, after), start, 0.005 * start);
        }
}

/// A bar of that density that vibrates in mode 1; on request with a block 20 m away. With the cure.
Scene bar_beside(double density, double density_of_block) {
    Scene scene = axial_bar();
    scene.grid.num_cells = {50, 1};
    scene.materials = {of_density("rubber", density)};
    scene.courant_number = 0.4;
    scene.effects = {{"locking_cure", {}}};
    if (density_of_block > 0) {
        scene.materials.push_back(of_density("heavy", density_of_block));
        scene.bodies.push_back(box_of("heavy", 45, 48));
    }
    return scene;
}

TEST(LeastMass, of_a_body_does_not_depend_on_one_that_it_never_touches) {
    for (const double density : {0.01, 0.05, 20.0}) {
        Simulation alone(bar_beside(density, 0), MPI_COMM_WORLD);
        Simulation beside(bar_beside(density, 1), MPI_COMM_WORLD);
        while (alone.time() < 20) {
            alone.step();
            beside.step();
        }
        const Totals a = alone.totals(), b = beside.totals();
        const double energy = a.kinetic_energy + a.strain_energy;
        EXPECT_NEAR(b.kinetic_energy + b.strain_energy, energy, 1e-9 * energy) << density;
    }
}

/// A block of a number of points along a cell that strikes a heavier disk.
Scene block_and_disk(int points) {
    return {.name = "block and disk",
            .grid = {.lower = {0, 0}, .spacing = 0.5, .num_cells = {16, 12}},
            .materials = {elastic_material("light", 1000, 1e6, 0),
                          elastic_material("heavy", 2100, 1e6, 0.3)},
            .bodies = {{.contains = box_region({{0.8, 0}, {3.6, 2.7}}),
                        .points_per_cell = {points, points, 1},
                        .material = "light",
                        .velocity = velocity_field({.constant = {5, 0}})},
                       {.contains = ball_region({5.8, 1.35}, 1.35), .material = "heavy"}},
            .walls = {.left = Wall::roller,
                      .right = Wall::fixed,
                      .bottom = Wall::roller,
                      .top = Wall::roller},
            .effects = {{"locking_cure", {}}},
            .end_time = 2};
}

/// Two balls side by side, one of which passes the other.
Scene two_balls() {
    return {.name = "two balls",
            .dimension = 3,
            .grid = {.lower = {0, 0, 0}, .spacing = 0.25, .num_cells = {8, 8, 8}},
            .materials = {elastic_material("light", 1000, 1e6, 0.3),
                          elastic_material("heavy", 1800, 3e7, 0.49)},
            .bodies = {{.contains = ball_region({0.55, 0.95, 0.5}, 0.35),
                        .points_per_cell = {3, 3, 3},
                        .material = "light"},
                       {.contains = ball_region({1.45, 0.95, 0.5}, 0.35),
                        .points_per_cell = {2, 2, 2},
                        .material = "heavy",
                        .velocity = velocity_field({.constant = {0, 1, 1}})}},
            .effects = {{"locking_cure", {}}},
            .end_time = 0.22};
}

// Slopes at the points vanish at the rim of quadratic functions; those of the centre, which the
// cure takes, do not.
TEST(LeastMass, keeps_bodies_of_two_densities_stable_with_the_cure) {
    for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::quadratic})
        for (Scene scene : {block_and_disk(1), block_and_disk(2), block_and_disk(4), two_balls()}) {
            scene.shape_function = shape;
            Simulation simulation(scene, MPI_COMM_WORLD);
            const double start = total_energy(simulation);
            while (simulation.time() < scene.end_time) {
                simulation.step();
                ASSERT_LT(total_energy(simulation), 1.05 * start) << scene.name;
            }
        }
}

// A least mass of a quarter of C^2, as linear functions want it, multiplies the energy by 400.
TEST(LeastMass, is_none_where_slopes_vanish_at_the_rim) {
    const Body beam{.contains = box_region({{0, 1}, {10, 2}}),
                    .material = "rubber",
                    .velocity = [](const Vector& at) {
                        return Vector{0, 0.5 * (1 - std::cos(std::numbers::pi * at[0] / 20)), 0};
                    }};
    const Scene scene{.name = "beam",
                      .grid = {.lower = {0, 0}, .spacing = 0.25, .num_cells = {44, 12}},
                      .materials = {elastic_material("rubber", 1000, 5e6, 0.2)},
                      .bodies = {beam},
                      .walls = {.left = Wall::fixed},
                      .shape_function = ShapeFunction::quadratic,
                      .courant_number = 0.5};
    Simulation simulation(scene, MPI_COMM_WORLD);
    const double start = total_energy(simulation);
    while (simulation.time() < 1) simulation.step();
    EXPECT_LT(total_energy(simulation), start);
    EXPECT_GT(total_energy(simulation), 0.98 * start);
}

}  // namespace
}  // namespace mpm::test
