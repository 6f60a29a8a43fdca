// Bodies that come to a wall with friction, at two stiffnesses, time steps and cell sizes.
#include "support.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

namespace mpm::test {
namespace {

constexpr double g = 9.81;

struct Case {
    double modulus = 1e6, courant_number = 0.5, cell_size = 0.25;
};
constexpr std::array cases{Case{}, Case{.modulus = 1e7}, Case{.courant_number = 0.2},
                           Case{.cell_size = 0.125}};

/// A body over a bottom with friction; damping as asked for.
Scene over_ground(const Case& varied, const Region& body, double friction,
                  std::vector<Effect> effects) {
    const auto cells = [&](double metres) { return static_cast<int>(metres / varied.cell_size); };
    return {
        .name = "over ground",
        .grid = {.lower = {0, 0}, .spacing = varied.cell_size, .num_cells = {cells(12), cells(3)}},
        .materials = {elastic_material("block", 1000, varied.modulus, 0.3)},
        .bodies = {{.contains = body, .points_per_cell = {2, 2, 1}, .material = "block"}},
        .walls = {.bottom = {Wall::frictional, friction}},
        .effects = std::move(effects),
        .courant_number = varied.courant_number};
}

/// Height at which a block of 1 m comes to rest that begins at a height above the ground.
double height_of_rest(const Case& varied, double above) {
    const Scene scene =
        over_ground(varied, box_region({{1, above}, {2, 1 + above}}), 0.3,
                    {gravity_effect(g), {"damping", {{"rate", 20.0}, {"until", 9.0}}}});
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < 2) simulation.step();
    EXPECT_LT(simulation.max_speed(), 1e-2);
    return simulation.totals().center[1];
}

TEST(Contact, lets_a_lowered_block_come_to_rest_where_one_stands_that_was_put_down) {
    for (const Case& varied : cases)
        EXPECT_NEAR(height_of_rest(varied, varied.cell_size), height_of_rest(varied, 0),
                    0.01 * varied.cell_size);
}

/// Way along the ground of a disk of radius 1 on a slope whose weight pulls it along.
double way_of_disk(const Case& varied, double slope, double friction, double time) {
    Scene scene = over_ground(
        varied, ball_region({1.5, 1}, 1), friction,
        {{"gravity",
          {{"acceleration", std::vector<double>{g * std::sin(slope), -g * std::cos(slope)}}}}});
    scene.bodies.front().points_per_cell = {4, 4, 1};
    scene.shape_function = ShapeFunction::quadratic;
    Simulation simulation(scene, MPI_COMM_WORLD);
    const double start = simulation.totals().center[0];
    while (simulation.time() < time) simulation.step();
    const Totals end = simulation.totals();
    return end.center[0] - start - end.momentum[0] / end.mass * (simulation.time() - time);
}

// Rolling, g sin(b) t^2 / 3; sliding, with friction below tan(b) / 3, g (sin b - mu cos b) t^2 / 2.
// The rim is a staircase of points, which slows what rolls, the more the stiffer the steps are.
TEST(Contact, lets_a_disk_roll_and_slide) {
    constexpr double slope = 20 * std::numbers::pi / 180, time = 1.5;
    const double rolling = g * std::sin(slope) * time * time / 3;
    const double sliding = g * (std::sin(slope) - 0.05 * std::cos(slope)) * time * time / 2;
    for (Case varied : cases) {
        varied.cell_size *= 0.5;
        const double tolerance = varied.modulus > 1e6 ? 0.07 : 0.03;
        EXPECT_NEAR(way_of_disk(varied, slope, 0.6, time), rolling, tolerance * rolling);
        EXPECT_NEAR(way_of_disk(varied, slope, 0.05, time), sliding, 0.01 * sliding);
    }
}

// Whatever the friction and the time step, a block that strikes the ground gains no energy.
TEST(Contact, gives_a_body_that_strikes_no_energy) {
    for (const Case& varied : cases)
        for (const double friction : {0.0, 0.5}) {
            Scene scene = over_ground(varied, box_region({{2, 0.5}, {3, 1.5}}), friction, {});
            scene.bodies.front().velocity = velocity_field({.constant = {2, -2}});
            Simulation simulation(scene, MPI_COMM_WORLD);
            const double start = simulation.totals().kinetic_energy;
            while (simulation.time() < 1) {
                simulation.step();
                const Totals now = simulation.totals();
                ASSERT_LE(now.kinetic_energy + now.strain_energy, 1.01 * start);
            }
            EXPECT_GT(simulation.totals().momentum[1], 0) << "it has bounced";
        }
}

}  // namespace
}  // namespace mpm::test
