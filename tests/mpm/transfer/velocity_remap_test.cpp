#include "support.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

namespace mpm::test {
namespace {

Scene bar(ShapeFunction shape) {
    Scene scene = axial_bar();
    scene.shape_function = shape;
    scene.time_integration = TimeIntegration::modified;
    return scene;
}

TEST(VelocityRemap, keeps_velocity_period_and_energy_of_a_bar) {
    for (const auto shape :
         {ShapeFunction::linear, ShapeFunction::quadratic, ShapeFunction::gimp}) {
        Simulation simulation(bar(shape), MPI_COMM_WORLD);
        const double initial = simulation.totals().kinetic_energy;
        std::vector<double> zeros;
        double before = simulation.totals().momentum[0];
        while (simulation.time() < 13) {
            const double start = simulation.time();
            for (int step = 0; step < 5; ++step) simulation.step();
            const Totals now = simulation.totals();
            if ((before > 0) != (now.momentum[0] > 0))
                zeros.push_back(start +
                                (simulation.time() - start) * before / (before - now.momentum[0]));
            before = now.momentum[0];
            EXPECT_NEAR(before / now.mass, 0.0636620 * std::cos(0.6283185 * simulation.time()),
                        0.02 * 0.0636620);
            // Stress and velocity are half a step apart: omega dt / 2 = 0.3 %, and strains are
            // finite.
            EXPECT_NEAR(now.kinetic_energy + now.strain_energy, initial, 0.005 * initial);
        }
        ASSERT_EQ(zeros.size(), 3u);
        EXPECT_NEAR(zeros[2] - zeros[0], 10, 0.015);
    }
}

// The same bar with a third axis that nothing happens along.
TEST(VelocityRemap, is_the_same_in_three_dimensions) {
    Scene solid = bar(ShapeFunction::linear);
    solid.dimension = 3;
    solid.grid.num_cells[2] = 1;
    solid.bodies.front().contains = box_region({{0, 0, 0}, {25, 1, 1}});
    solid.walls.back = solid.walls.front = Wall::roller;
    Simulation in_space(solid, MPI_COMM_WORLD),
        in_plane(bar(ShapeFunction::linear), MPI_COMM_WORLD);
    for (int step = 0; step < 300; ++step) {
        in_space.step();
        in_plane.step();
    }
    EXPECT_EQ(in_space.doubles_per_ghost_node(), 10u);
    const Totals space = in_space.totals(), plane = in_plane.totals();
    EXPECT_NEAR(space.strain_energy, plane.strain_energy, 1e-12 * plane.strain_energy);
    EXPECT_NEAR(space.momentum[0], plane.momentum[0], 1e-12 * plane.mass);
}

/// A damped column of 0.1 m under its weight on a fixed floor.
Scene column(int cells_up, ShapeFunction shape) {
    return {.name = "column",
            .grid = {.lower = {0, 0},
                     .spacing = 0.1 / cells_up,
                     .num_cells = {2 * cells_up, cells_up + 2}},
            .materials = {elastic_material("soil", 1800, 1e6, 0)},
            .bodies = {{.contains = half_space_region({0, 0.1}, {0, 1}),
                        .points_per_cell = {2, 2, 1},
                        .material = "soil"}},
            .walls = {.left = Wall::roller, .right = Wall::roller, .bottom = Wall::fixed},
            .effects = {gravity_effect(9.81), {"damping", {{"rate", 740.0}, {"until", 1.0}}}},
            .shape_function = shape,
            .time_integration = TimeIntegration::modified};
}

/// Largest error of the vertical stress at the points' own depths, by the stress at the base.
double error_of(int cells_up, ShapeFunction shape) {
    Simulation simulation(column(cells_up, shape), MPI_COMM_WORLD);
    while (simulation.time() < 0.1) simulation.step();
    const std::vector<double> y = gathered(simulation, "y", MPI_COMM_WORLD);
    const std::vector<double> stress = gathered(simulation, "stress_yy", MPI_COMM_WORLD);
    const double surface = *std::ranges::max_element(y) + 0.1 / cells_up / 4;
    double worst = 0;
    for (std::size_t p = 0; p < y.size(); ++p)
        worst = std::max(worst, std::abs(stress[p] + 1800 * 9.81 * (surface - y[p])));
    return worst / (1800 * 9.81 * 0.1);
}

// A cell of linear functions has the stress of its middle, a quarter of a cell from its points; see
// hydrostatic_test.
TEST(VelocityRemap, leaves_a_column_at_rest_under_its_weight) {
    EXPECT_NEAR(error_of(8, ShapeFunction::linear), 0.25 / 8, 0.003);
    EXPECT_NEAR(error_of(16, ShapeFunction::linear), 0.25 / 16, 0.003);
    EXPECT_LT(error_of(8, ShapeFunction::quadratic), 0.05);
}

/// A disk that flies and spins, with nodes of next to no mass strained as they are accelerated.
Scene bare_disk(TimeIntegration integration) {
    Scene scene = flying_disk();
    scene.least_node_mass = 1e-9;
    scene.flip_fraction = 1;
    scene.effects = {{"energy_audit", {}}};
    scene.time_integration = integration;
    return scene;
}

TEST(VelocityRemap, needs_no_least_mass_of_nodes) {
    Simulation simulation(bare_disk(TimeIntegration::modified), MPI_COMM_WORLD);
    const double initial = simulation.totals().kinetic_energy;
    while (simulation.time() < 1.5) simulation.step();
    const Totals end = simulation.totals();
    EXPECT_NEAR(end.kinetic_energy, initial, 0.002 * initial);
    EXPECT_LT(end.strain_energy, 0.002 * initial);
    EXPECT_NEAR(total_energy(simulation), initial, 0.001 * initial);
    const auto fly = [](TimeIntegration integration) {
        Simulation other(bare_disk(integration), MPI_COMM_WORLD);
        while (other.time() < 1.5) other.step();
    };
    EXPECT_THROW(fly(TimeIntegration::update_stress_last), std::runtime_error) << "it flies apart";
}

/// The disk against a roller wall, a frictional floor and an inclined plane.
Scene bumping_disk(ShapeFunction shape) {
    Scene scene = flying_disk();
    scene.bodies.front().velocity = velocity_field({.constant = {-8, -6}});
    scene.walls = {.left = Wall::roller, .bottom = {Wall::frictional, 0.3}};
    scene.planes = {{"ramp", {0, 3}, {1, 1}, {Wall::frictional, 0.2}}};
    scene.effects = {gravity_effect(9.81), {"energy_audit", {}}};
    scene.shape_function = shape;
    scene.time_integration = TimeIntegration::modified;
    scene.courant_number = 0.1;
    scene.flip_fraction = 0.97;  // On linear functions the impact feeds noise.
    return scene;
}

TEST(VelocityRemap, is_the_same_on_any_number_of_ranks_and_accounts_for_energy) {
    for (const auto shape : {ShapeFunction::linear, ShapeFunction::quadratic}) {
        Simulation parallel(bumping_disk(shape), MPI_COMM_WORLD);
        Simulation serial(bumping_disk(shape), MPI_COMM_SELF);
        const double initial = total_energy(serial);
        while (serial.time() < 0.4) {
            parallel.step();
            serial.step();
        }
        const double kinetic = 0.5 * serial.totals().mass * 100;
        EXPECT_GT(lost_energy(serial), 0.02 * kinetic) << "it has bumped";
        EXPECT_NEAR(total_energy(serial), initial, 0.005 * kinetic);
        for (const std::string column : {"displacement_x", "displacement_y", "velocity_x"})
            EXPECT_LT(relative_difference(gathered(serial, column, MPI_COMM_SELF),
                                          gathered(parallel, column, MPI_COMM_WORLD)),
                      1e-12)
                << column;
    }
}

TEST(VelocityRemap, is_there_where_it_is_named_only) {
    Scene scene = bar(ShapeFunction::linear);
    const Simulation modified(scene, MPI_COMM_WORLD);
    EXPECT_EQ(modified.kernels(),
              (std::vector<std::string>{"p2g", "ghost_nodes", "walls", "move_nodes", "remap",
                                        "walls", "g2p", "elastic", "migrate"}));
    EXPECT_EQ(modified.doubles_per_ghost_node(), 7u);
    scene.time_integration = TimeIntegration::update_stress_last;
    const Simulation plain(scene, MPI_COMM_WORLD);
    EXPECT_EQ(plain.doubles_per_ghost_node(), 5u);
    EXPECT_EQ(std::ranges::count(plain.kernels(), "remap"), 0);
}

TEST(VelocityRemap, refuses_what_it_does_not_know) {
    Scene scene = bar(ShapeFunction::linear);
    scene.transfer = Transfer::apic;
    EXPECT_THROW(validate(scene), std::invalid_argument);
}

}  // namespace
}  // namespace mpm::test
