#include "support.hpp"

#include <gtest/gtest.h>
#include <penetrator.hpp>

namespace mpm::test {
namespace {

double report(const Simulation& simulation, const std::string& name) {
    for (const auto& [key, value] : simulation.reports())
        if (key == name) return value;
    return std::numeric_limits<double>::quiet_NaN();
}

TEST(Penetrator, has_the_normal_of_the_nearer_surface) {
    // A cone of 3-4-5 below a cylinder.
    const Penetrator<3> body{
        .tip = {1, 2, 3}, .radius = 3, .cone_height = 4, .length = 10, .mass = 1};
    const auto on_cone = body.normal_inside({2, 3.5, 3});
    ASSERT_TRUE(on_cone);
    EXPECT_NEAR((*on_cone)[0], 0.8, 1e-15);
    EXPECT_NEAR((*on_cone)[1], -0.6, 1e-15);
    EXPECT_NEAR((*on_cone)[2], 0, 1e-15);
    const auto on_side = body.normal_inside({1, 11, 5.9});
    ASSERT_TRUE(on_side);
    EXPECT_EQ(*on_side, (Components<3>{0, 0, 1}));
    EXPECT_FALSE(body.normal_inside({2, 3.3, 3})) << "below the cone: 4 / 3 high there";
    EXPECT_FALSE(body.normal_inside({1, 8, 6.1}));
    EXPECT_FALSE(body.normal_inside({1, 12.1, 3}));
    EXPECT_EQ(*body.normal_inside({1, 2.5, 3}), (Components<3>{0, -1, 0})) << "on the axis";
    const Penetrator<2> plate{.tip = {0, 0}, .radius = 2, .length = 1, .mass = 1};
    EXPECT_EQ(*plate.normal_inside({1, 0.5}), (Components<2>{0, -1}));
    EXPECT_NEAR((*plate.normal_inside({-1.9, 0.5}))[0], -1, 1e-15);
}

TEST(Contact, takes_friction_by_what_the_normal_velocity_lost_and_no_more_than_its_limit) {
    using Velocity = Components<2>;
    Surface<2> floor{.normal = {0, 1}, .friction = 0.5};
    EXPECT_EQ(after_contact<2>(floor, {3, -2}), (Velocity{2, 0}));
    EXPECT_EQ(after_contact<2>(floor, {3, 2}), (Velocity{3, 2})) << "it leaves";
    EXPECT_EQ(after_contact<2>(floor, {0.5, -2}), (Velocity{0, 0})) << "it sticks";
    floor.most_lost = 0.25;
    EXPECT_EQ(after_contact<2>(floor, {3, -2}), (Velocity{2.75, 0}));
    floor.velocity = {1, -1};
    EXPECT_EQ(after_contact<2>(floor, {3, -2}), (Velocity{2.75, -1}));
    EXPECT_EQ(after_contact<2>(floor, {3, -0.5}), (Velocity{3, -0.5}));
}

/// A block that floats in an open grid with a plate that falls on its upper side.
Scene struck_block(double mass, double speed) {
    return {.name = "struck",
            .grid = {.lower = {0, 0}, .spacing = 0.5, .num_cells = {12, 16}},
            .materials = {elastic_material("rubber", 1000, 1e6, 0.3)},
            .bodies = {{.contains = box_region({{2, 3}, {4, 5}}),
                        .points_per_cell = {2, 2, 1},
                        .material = "rubber"}},
            .effects = {{"penetrator",
                         {{"tip", std::vector<double>{3, 5.1}},
                          {"radius", 1.5},
                          {"length", 1.0},
                          {"mass", mass},
                          {"velocity", -speed}}},
                        {"energy_audit", {}}},
            .courant_number = 0.1};
}

// What the body loses the block gains; energy only goes. A plate that is much heavier keeps its
// speed, and at the end the block is thrown off at a higher one.
TEST(Penetrator, keeps_momentum_and_gains_no_energy) {
    constexpr double mass = 2000, speed = 2;
    Simulation simulation(struck_block(mass, speed), MPI_COMM_WORLD);
    double least = speed;
    while (simulation.time() < 0.6) {
        for (int step = 0; step < 25; ++step) simulation.step();
        const Totals soil = simulation.totals();
        const double velocity = report(simulation, "penetrator_velocity");
        EXPECT_NEAR(mass * velocity + soil.momentum[1], -mass * speed, 1e-9 * mass * speed);
        EXPECT_LT(0.5 * mass * velocity * velocity + soil.kinetic_energy + soil.strain_energy,
                  0.5 * mass * speed * speed * 1.001);
        EXPECT_NEAR(soil.kinetic_energy + soil.strain_energy + soil.dissipated_energy.value(), 0,
                    0.01 * 0.5 * mass * speed * speed);
        least = std::min(least, std::abs(velocity));
    }
    EXPECT_LT(least, 0.7 * speed);
}

TEST(Penetrator, falls_freely_before_it_meets_the_soil) {
    Scene scene = struck_block(100, 0);
    find_effect(scene, "penetrator")->at("tip") = std::vector<double>{3, 7};
    scene.effects.push_back(gravity_effect(10));
    scene.effects.front().parameters["weight_share"] = 0.5;
    Simulation simulation(scene, MPI_COMM_WORLD);
    double velocity = 0, tip = 7;
    while (simulation.time() < 0.2) {
        velocity -= 5 * simulation.time_step();
        tip += simulation.time_step() * velocity;
        simulation.step();
        EXPECT_NEAR(report(simulation, "penetrator_velocity"), velocity, 1e-13);
        EXPECT_NEAR(report(simulation, "penetrator_tip_y"), tip, 1e-13);
    }
}

/// A heavy plate as wide as an elastic column of 2 m x 2 m comes down slowly on it.
Scene pressed_column(double poissons_ratio) {
    return {.name = "oedometer",
            .grid = {.lower = {0, 0}, .spacing = 0.25, .num_cells = {8, 12}},
            .materials = {elastic_material("soil", 1000, 1e6, poissons_ratio)},
            .bodies = {{.contains = box_region({{0, 0}, {2, 2}}),
                        .points_per_cell = {2, 2, 1},
                        .material = "soil"}},
            .walls = {.left = Wall::roller, .right = Wall::roller, .bottom = Wall::fixed},
            .effects = {{"penetrator",
                         {{"tip", std::vector<double>{1, 1.99}},
                          {"radius", 10.0},
                          {"length", 1.0},
                          {"mass", 1e12},
                          {"velocity", -0.005}}},
                        {"damping", {{"rate", 40.0}, {"until", 10.0}}}}};
}

/// Mean force between two times, N.
double mean_force(Simulation& simulation, double from, double to) {
    double impulse = 0, start = 0;
    while (simulation.time() < from) simulation.step();
    start = simulation.time();
    while (simulation.time() < to) {
        const double time_step = simulation.time_step();
        simulation.step();
        impulse += time_step * report(simulation, "penetrator_force");
    }
    return impulse / (simulation.time() - start);
}

// From then on the nodes at y = 2 keep the speed of the plate, and the force grows by the
// oedometer's stiffness: modulus E (1 - nu) / ((1 + nu) (1 - 2 nu)) * 2 m wide / 2 m high.
TEST(Penetrator, feels_the_stiffness_of_a_confined_column) {
    constexpr double ratio = 0.25, speed = 0.005;
    Simulation simulation(pressed_column(ratio), MPI_COMM_WORLD);
    const double first = mean_force(simulation, 0.5, 0.7);
    const double second = mean_force(simulation, 1.5, 1.7);
    const double modulus = 1e6 * (1 - ratio) / ((1 + ratio) * (1 - 2 * ratio));
    const double expected = modulus * 2 / 2 * speed;
    EXPECT_NEAR(second - first, expected, 0.05 * expected);
}

}  // namespace
}  // namespace mpm::test
