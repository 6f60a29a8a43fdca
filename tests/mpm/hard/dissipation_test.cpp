// What the method dissipates: the shares in docs/energy.md, best and worst set-ups side by side.
#include "support.hpp"

#include <gtest/gtest.h>

namespace mpm::test {
namespace {

/// Two bars of 20 cells, their speeds by that of waves.
Scene two_bars(ShapeFunction shape, double courant_number, double left, double right) {
    constexpr double wave_speed = 10;
    const auto bar = [](double begin, double speed) {
        return Body{.contains = box_region({{begin, 0}, {begin + 20, 2}}),
                    .material = "rubber",
                    .velocity = velocity_field({.constant = {speed * wave_speed, 0}})};
    };
    return {.name = "bars",
            .grid = {.lower = {0, 0}, .spacing = 1, .num_cells = {90, 2}},
            .materials = {elastic_material("rubber", 1, 100, 0)},
            .bodies = {bar(15, left), bar(40, right)},
            .walls = {.bottom = Wall::roller, .top = Wall::roller},
            .shape_function = shape,
            .courant_number = courant_number};
}

double energy_left(const Scene& scene, double end_time) {
    Simulation simulation(scene, MPI_COMM_WORLD);
    const double start = total_energy(simulation);
    while (simulation.time() < end_time) simulation.step();
    return total_energy(simulation) / start;
}

// Bars of the same speed meet alike; a bar that strikes one at rest crosses cells under stress.
TEST(Dissipation, of_bars_that_collide_is_the_documented_one) {
    struct Case {
        ShapeFunction shape;
        double courant_number, towards, at_rest;
    };
    for (const auto& [shape, courant_number, towards, at_rest] :
         {Case{ShapeFunction::linear, 0.4, 0.85, 0.55},
          Case{ShapeFunction::linear, 0.1, 0.95, 0.61},
          Case{ShapeFunction::quadratic, 0.4, 0.99, 0.80},
          Case{ShapeFunction::quadratic, 0.1, 1.00, 0.81}}) {
        SCOPED_TRACE(courant_number);
        EXPECT_NEAR(energy_left(two_bars(shape, courant_number, 0.01, -0.01), 37), towards, 0.01);
        EXPECT_NEAR(energy_left(two_bars(shape, courant_number, 0.1, 0), 17), at_rest, 0.01);
    }
}

/// A disk of 3 cells' radius that turns at 0.4 % of the wave speed, off the nodes.
Scene turning_disk(ShapeFunction shape, int points) {
    const Vector centre{5.13, 5.065};
    return {.name = "disk",
            .grid = {.lower = {0, 0}, .spacing = 1, .num_cells = {10, 10}},
            .materials = {elastic_material("rubber", 1000, 1e6, 0.3)},
            .bodies = {{.contains = ball_region(centre, 3),
                        .points_per_cell = {points, points, 1},
                        .material = "rubber",
                        .velocity =
                            velocity_field({.rotation_rate = 0.05, .rotation_centre = centre})}},
            .shape_function = shape};
}

double angular_momentum(const Simulation& simulation) {
    const Vector centre = simulation.totals().center;
    const Particles& points = simulation.particles();
    return summed(simulation, MPI_COMM_WORLD, [&](std::size_t p) {
        return points["mass"][p] * ((points["x"][p] - centre[0]) * points["velocity_y"][p] -
                                    (points["y"][p] - centre[1]) * points["velocity_x"][p]);
    });
}

TEST(Dissipation, of_disks_that_turn_is_the_documented_one) {
    struct Case {
        ShapeFunction shape;
        int points;
        double energy, angular_momentum;
    };
    for (const auto& [shape, points, energy, momentum] :
         {Case{ShapeFunction::linear, 2, 0.16, 0.35}, Case{ShapeFunction::linear, 4, 0.57, 0.72},
          Case{ShapeFunction::quadratic, 2, 0.22, 0.38},
          Case{ShapeFunction::quadratic, 4, 0.72, 0.81}}) {
        SCOPED_TRACE(points);
        Simulation simulation(turning_disk(shape, points), MPI_COMM_WORLD);
        const double before = total_energy(simulation), turn = angular_momentum(simulation);
        while (simulation.step_count() < 30000) simulation.step();
        EXPECT_NEAR(total_energy(simulation) / before, energy, 0.03);
        EXPECT_NEAR(angular_momentum(simulation) / turn, momentum, 0.03);
    }
}

}  // namespace
}  // namespace mpm::test
