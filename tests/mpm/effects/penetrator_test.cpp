#include "paper/penetrator.hpp"

#include "support.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

namespace mpm::test {
namespace {

/// A cone of 3-4-5 below a cylinder.
const Penetrator<3> pencil{
    .tip = {1, 2, 3}, .radius = 3, .cone_height = 4, .length = 10, .mass = 1};

TEST(Penetrator, has_the_normal_of_the_nearest_surface) {
    const auto on_cone = pencil.touch({2, 3.5, 3}, 0);
    ASSERT_TRUE(on_cone);
    EXPECT_NEAR(on_cone->depth, 0.1, 1e-15) << "(3 * 1.5 - 4 * 1) / 5";
    EXPECT_NEAR(on_cone->normal[0], 0.8, 1e-15);
    EXPECT_NEAR(on_cone->normal[1], -0.6, 1e-15);
    EXPECT_NEAR(on_cone->normal[2], 0, 1e-15);
    const auto on_side = pencil.touch({1, 11, 5.9}, 0);
    ASSERT_TRUE(on_side);
    EXPECT_NEAR(on_side->depth, 0.1, 1e-15);
    EXPECT_EQ(on_side->normal, (Components<3>{0, 0, 1}));
    const auto on_top = pencil.touch({2, 11.5, 3}, 0);
    ASSERT_TRUE(on_top);
    EXPECT_EQ(on_top->normal, (Components<3>{0, 1, 0}));
    EXPECT_EQ(pencil.touch({1, 2.5, 3}, 0)->normal, (Components<3>{0, -1, 0})) << "on the axis";
    const Penetrator<2> plate{.tip = {0, 0}, .radius = 2, .length = 1, .mass = 1};
    EXPECT_EQ(plate.touch({1, 0.4}, 0)->normal, (Components<2>{0, -1}));
    EXPECT_NEAR(plate.touch({-1.9, 0.5}, 0)->normal[0], -1, 1e-15);
}

TEST(Penetrator, touches_what_is_within_the_size_of_a_point) {
    EXPECT_FALSE(pencil.touch({2, 3.3, 3}, 0)) << "below the cone: 4 / 3 high there";
    EXPECT_NEAR(pencil.touch({2, 3.3, 3}, 0.1)->depth, 0.08, 1e-15) << "0.02 away";
    EXPECT_FALSE(pencil.touch({1, 8, 6.1}, 0.05));
    EXPECT_NEAR(pencil.touch({1, 8, 6.1}, 0.25)->depth, 0.15, 1e-14);
    EXPECT_FALSE(pencil.touch({1, 12.1, 3}, 0));
    EXPECT_NEAR(pencil.touch({1, 12.1, 3}, 0.2)->depth, 0.1, 1e-14);
}

TEST(Penetrator, knows_its_volume_and_surface) {
    constexpr double pi = std::numbers::pi;
    EXPECT_NEAR(pencil.volume(), (12 + 54) * pi, 1e-13);
    EXPECT_NEAR(pencil.area_below(2), 1.5 * 2.5 * pi, 1e-14);
    EXPECT_NEAR(pencil.area_below(10), (15 + 36) * pi, 1e-13);
    const Penetrator<2> wedge{
        .tip = {0, 0}, .radius = 3, .cone_height = 4, .length = 10, .mass = 1};
    EXPECT_NEAR(wedge.volume(), 12 + 36, 1e-14);
    EXPECT_NEAR(wedge.area_below(10), 2 * (5 + 6), 1e-14);
    const GridShape grid{.lower = {0, -5, 3}, .spacing = 1, .num_cells = {9, 9, 9}};
    EXPECT_EQ(pencil.share_in(grid), 0.5) << "on the side z = 3";
}

// Two bands of 2 m2 each with a normal force of 10 N and a limit of 0.5 Pa: 1 N of friction.
TEST(FrictionBands, bound_friction_by_the_limit_on_their_area) {
    const Penetrator<2> plate{.tip = {0, 0}, .radius = 1, .length = 2, .mass = 1};
    FrictionBands<2> bands(plate, 1, 1);
    EXPECT_EQ(bands.most_at(0.5, 0.3), 0.3) << "nothing known yet";
    for (int step = 0; step < 400; ++step) {
        bands.add(0.2, 4, 0.5);
        bands.add(0.8, 6, 0.5);
        bands.add(1.5, 1, 0.5);
        bands.settle(std::vector<double>(bands.sums().begin(), bands.sums().end()), 0.05);
    }
    EXPECT_NEAR(bands.most_at(0.5, 0.3), 0.1, 1e-8);
    EXPECT_EQ(bands.most_at(1.5, 0.3), 0.3) << "1 N on it: Coulomb allows less";
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
                          {"velocity", -speed}}}},
            .courant_number = 0.1};
}

// What the body loses the block gains; energy only goes. A plate that is much heavier keeps its
// speed, and at the end the block is thrown off at a higher one.
TEST(Penetrator, keeps_momentum_and_gains_no_energy) {
    constexpr double mass = 2000, speed = 2;
    Simulation simulation(struck_block(mass, speed), MPI_COMM_WORLD);
    const double initial = 0.5 * mass * speed * speed;
    double least = speed;
    while (simulation.time() < 0.6) {
        for (int step = 0; step < 25; ++step) simulation.step();
        const Totals soil = simulation.totals();
        const double velocity = report(simulation, "penetrator_velocity");
        EXPECT_NEAR(mass * velocity + soil.momentum[1], -mass * speed, 1e-9 * mass * speed);
        const double of_plate = 0.5 * mass * velocity * velocity;
        EXPECT_LT(of_plate + soil.kinetic_energy + soil.strain_energy, initial * 1.001);
        least = std::min(least, std::abs(velocity));
    }
    EXPECT_LT(least, 0.7 * speed);
}

/// What body and block have gained together of their momentum along y, by that at the start.
double lost_momentum(Scene scene, double mass, double speed) {
    scene.grid.lower[0] = 3;
    scene.walls.left = Wall::roller;
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < 0.3) simulation.step();
    const double velocity = report(simulation, "penetrator_velocity");
    EXPECT_GT(simulation.totals().momentum[1], -0.99 * mass * speed);
    EXPECT_LT(simulation.totals().momentum[1], -0.1 * mass * speed) << "it has struck";
    return 1 + (mass * velocity + simulation.totals().momentum[1]) / (mass * speed);
}

// A wall that cuts body and block in halves takes no momentum along it, whatever reaches beyond it.
TEST(Penetrator, keeps_momentum_at_a_wall_through_its_axis) {
    constexpr double mass = 2000, speed = 2;
    for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::quadratic}) {
        Scene scene = struck_block(mass, speed);
        scene.shape_function = shape;
        EXPECT_NEAR(lost_momentum(scene, mass, speed), 0, 1e-10);
    }
}

// A block thrown flat on the top of a body that stands loses friction * the momentum it gains
// across it, for as long as it slides.
TEST(Penetrator, rubs_by_coulomb) {
    constexpr double friction = 0.25, fast = 5, down = 1;
    Scene scene = struck_block(1e12, 0);
    Parameters& body = *find_effect(scene, "penetrator");
    body["tip"] = std::vector<double>{3, 1.9};
    body["radius"] = 10.0;
    body["friction"] = friction;
    scene.bodies.front().velocity = velocity_field({.constant = {fast, -down}});
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < 0.2) simulation.step();
    const Totals after = simulation.totals();
    const double gained = after.momentum[1] + down * after.mass;
    EXPECT_GT(gained, 0.9 * down * after.mass) << "it has met the body";
    EXPECT_NEAR(fast * after.mass - after.momentum[0], friction * gained, 1e-9 * gained);
}

// Contact would hurl it out, with energy from nowhere.
TEST(Penetrator, may_not_begin_in_the_soil) {
    Scene scene = struck_block(100, 0);
    find_effect(scene, "penetrator")->at("tip") = std::vector<double>{3, 4.5};
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD), std::invalid_argument);
    scene.bodies.front().contains = box_region({{2, 3}, {4, 4.5}});
    EXPECT_NO_THROW(Simulation(scene, MPI_COMM_WORLD));
}

TEST(Penetrator, falls_freely_before_it_meets_the_soil) {
    Scene scene = struck_block(100, 0);
    find_effect(scene, "penetrator")->at("tip") = std::vector<double>{3, 7};
    scene.effects.push_back(gravity_effect(10));
    // Half its weight is carried by fluid, 3 m x 1 m of it.
    scene.effects.front().parameters["fluid_density"] = 0.5 * 100 / 3;
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
                        {"damping", {{"rate", 40.0}, {"until", 10.0}}}},
            .courant_number = 0.25};
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
