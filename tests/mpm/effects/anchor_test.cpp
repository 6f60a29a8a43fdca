#include "paper/penetrator.hpp"
#include "variations.hpp"
#include "words.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mpm::test {
namespace {

constexpr double g = 9.81;

/// Clay beside the upright axis of a body that a scene adds: a quarter, cut by symmetry.
Scene beside_axis(Parameters penetrator) {
    return {.name = "quarter",
            .dimension = 3,
            .grid = {.lower = {0, 0, 0}, .spacing = 0.5, .num_cells = {4, 4, 4}},
            .materials = {elastic_material("soil", 1000, 1e6, 0.3)},
            .bodies = {{.contains = box_region({{1, 0, 1}, {2, 1, 2}}), .material = "soil"}},
            .walls = {.left = Wall::roller, .bottom = Wall::fixed, .back = Wall::roller},
            .effects = {{"gravity", {{"acceleration", std::vector<double>{0, -g, 0}}}},
                        {"penetrator", std::move(penetrator)}}};
}

// m v' = (m - rho V) g - rho Cd A v^2 / 2 from rest: v_t tanh(t / tau).
TEST(AnchorInWater, falls_to_its_final_speed) {
    constexpr double water = 1000, volume = std::numbers::pi / 4 * 0.09 * (4 + 1.0 / 3);
    constexpr double mass = 2 * water * volume, drag = 0.8;
    Simulation simulation(beside_axis({{"tip", std::vector<double>{0, 100, 0}},
                                       {"radius", 0.3},
                                       {"cone_height", 1.0},
                                       {"length", 5.0},
                                       {"mass", mass},
                                       {"fluid_density", water},
                                       {"drag_coefficient", drag}}),
                          MPI_COMM_WORLD);
    const double weight = (mass - water * volume) * g;
    const double area = std::numbers::pi / 4 * 0.09;
    const double final_speed = std::sqrt(2 * weight / (water * drag * area));
    const double tau = mass * final_speed / weight;
    while (simulation.time() < 2 * tau) {
        simulation.step();
        // Euler's rule is late or early by half a step.
        EXPECT_NEAR(-report(simulation, "penetrator_velocity"),
                    final_speed * std::tanh(simulation.time() / tau), g * simulation.time_step());
    }
    EXPECT_GT(-report(simulation, "penetrator_velocity"), 0.95 * final_speed);
}

TEST(Anchor, needs_an_undrained_strength_to_stick_to) {
    const Scene scene = beside_axis({{"tip", std::vector<double>{0, 10, 0}},
                                     {"radius", 1.0},
                                     {"length", 5.0},
                                     {"mass", 1.0},
                                     {"adhesion_factor", 0.5}});
    expect_refused([&] { Simulation(scene, MPI_COMM_WORLD); },
                   {"'adhesion_factor' needs an undrained strength; the material 'soil'"});
}

constexpr double pull_speed = 0.2, band_height = 0.25;
constexpr double lateral_ratio = 0.9;
constexpr double top_strength = 4e3, strength_gradient = 2e3, clay_depth = 2;

/// Half a plate through a layer of clay, pulled up slowly once the clay is at rest under its
/// weight.
Scene pulled_plate(Parameters more) {
    Material clay = clay_material(2e6, top_strength, strength_gradient);
    clay.parameters["surface"] = clay_depth;
    Parameters plate{{"tip", std::vector<double>{0, -5}},
                     {"radius", 0.5},
                     {"length", 20.0},
                     {"mass", 1e12},
                     {"velocity", pull_speed},
                     {"fluid_density", 1e11}};  // which carries its weight
    plate.insert(more.begin(), more.end());
    return {.name = "pulled",
            .grid = {.lower = {0, 0}, .spacing = band_height, .num_cells = {10, 10}},
            .materials = {clay},
            .bodies = {{.contains = box_region({{0.5, 0}, {2.5, clay_depth}}),
                        .points_per_cell = {2, 2, 1},
                        .material = "clay"}},
            .walls = {.left = {Wall::frictional, 0}, .right = Wall::roller, .bottom = Wall::fixed},
            .effects = {{"gravity", {{"acceleration", std::vector<double>{0, -g}}}},
                        {"geostatic", {{"surface", clay_depth}, {"lateral_ratio", lateral_ratio}}},
                        {"penetrator", plate},
                        {"locking_cure", {}}}};
}

/// Mean force of the clay on the plate, N/m, over the way of a band of friction.
double pull(const Parameters& more, const Variation& varied = {}) {
    Scene scene = pulled_plate(more);
    vary(scene, varied);
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < 0.3) simulation.step();
    const double start = simulation.time();
    double impulse = 0;
    while (simulation.time() < start + band_height / pull_speed) {
        const double time_step = simulation.time_step();
        simulation.step();
        impulse += time_step * report(simulation, "penetrator_force");
    }
    return -impulse / (simulation.time() - start);
}

// Shear stress is a share of the strength, which grows with depth, over all of the side. A band
// that is only in part in the clay counts as a whole: half a band too much in the mean, at both
// ends.
TEST(Anchor, sticks_to_clay_by_its_strength) {
    constexpr double factor = 0.1, tolerance = band_height / clay_depth;
    const double strength = top_strength + strength_gradient * clay_depth / 2;
    const double expected = factor * strength * clay_depth;
    for (const Variation& varied : variations)
        EXPECT_NEAR(pull({{"friction", 1.0}, {"adhesion_factor", factor}}, varied), expected,
                    tolerance * expected)
            << varied;
}

// What must differ: Coulomb allows less where the coefficient is small, and nothing without one.
TEST(Anchor, slides_by_coulomb_where_that_is_less) {
    const double thrust = lateral_ratio * 1600 * g * clay_depth * clay_depth / 2;
    for (const Variation& varied : variations)
        EXPECT_NEAR(pull({{"friction", 0.01}}, varied), 0.01 * thrust, 0.15 * 0.01 * thrust)
            << varied;
    EXPECT_NEAR(pull({{"friction", 0.01}, {"adhesion_factor", 0.1}}), 0.01 * thrust,
                0.15 * 0.01 * thrust);
    EXPECT_NEAR(pull({}), 0, 1);
}

// Level ground with its stress stays as it is, whatever the lateral stress.
TEST(Geostatic, ground_rests_from_the_start) {
    Scene scene = pulled_plate({});
    std::erase_if(scene.effects, [](const Effect& effect) { return effect.name != "gravity"; });
    scene.effects.push_back({"geostatic", {{"surface", clay_depth}, {"lateral_ratio", 0.9}}});
    scene.bodies.front().contains = box_region({{0, 0}, {2.5, clay_depth}});
    scene.walls.left = Wall::roller;
    Simulation simulation(scene, MPI_COMM_WORLD);
    for (int step = 0; step < 200; ++step) simulation.step();
    EXPECT_LT(simulation.max_speed(), 1e-12);
    // What must differ: without it the ground settles.
    std::erase_if(scene.effects, [](const Effect& effect) { return effect.name == "geostatic"; });
    Simulation settling(scene, MPI_COMM_WORLD);
    for (int step = 0; step < 20; ++step) settling.step();
    EXPECT_GT(settling.max_speed(), 0.01);
}

/// The deepest that the centre of a point is in a body, m.
double deepest(const Simulation& simulation, Penetrator<2> body) {
    body.tip[1] = report(simulation, "penetrator_tip_y");
    const Positions at = simulation.positions();
    double depth = 0;
    for (std::size_t p = 0; p < at.size(); ++p)
        if (const auto touch = body.touch({at.x[p], at.y[p], 0}, 0))
            depth = std::max(depth, touch->depth);
    MPI_Allreduce(MPI_IN_PLACE, &depth, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return depth;
}

/// Soft clay at rest, with air above it, and a plate with a wedge that strikes it.
Scene struck_clay(double cell_size, const Penetrator<2>& plate) {
    return {.name = "struck",
            .grid = {.lower = {-6, -9}, .spacing = cell_size, .num_cells = {30, 38}},
            .materials = {clay_material(2e6, 2e3, 1.5e3)},
            .bodies = {{.contains = half_space_region({0, 0}, {0, 1}),
                        .points_per_cell = {3, 3, 1},
                        .material = "clay"}},
            .walls = {.left = Wall::roller, .right = Wall::roller, .bottom = Wall::fixed},
            .effects = {gravity_effect(g),
                        {"geostatic", {{"lateral_ratio", 0.82}}},
                        {"penetrator",
                         {{"tip", std::vector<double>{plate.tip[0], plate.tip[1]}},
                          {"radius", plate.radius},
                          {"cone_height", plate.cone_height},
                          {"length", plate.length},
                          {"mass", plate.mass},
                          {"velocity", plate.velocity},
                          {"friction", 0.3},
                          {"adhesion_factor", 0.5}}},
                        {"locking_cure", {}}},
            .courant_number = 0.3};
}

// Three times as fast as anchors fall: no energy is gained, and no clay gets into the plate.
TEST(Anchor, strikes_at_30_metres_a_second) {
    constexpr double cell_size = 0.4, speed = 30, mass = 2e3;
    const Penetrator<2> body{.tip = {0, 0.05},
                             .radius = 0.5,
                             .cone_height = 1,
                             .length = 4,
                             .mass = mass,
                             .velocity = -speed};
    Simulation simulation(struck_clay(cell_size, body), MPI_COMM_WORLD);
    const double kinetic = 0.5 * mass * speed * speed;
    const double initial = total_energy(simulation);
    while (simulation.time() < 0.6) {
        for (int step = 0; step < 20; ++step) simulation.step();
        // The clay gains no more than the plate has lost.
        const double v = report(simulation, "penetrator_velocity");
        const double fall = -report(simulation, "penetrator_tip_y");
        EXPECT_LT(total_energy(simulation) - initial,
                  kinetic - 0.5 * mass * v * v + mass * g * (fall + 0.1) + 0.01 * kinetic);
        EXPECT_GT(report(simulation, "penetrator_velocity"), -speed - g * simulation.time());
        EXPECT_LT(deepest(simulation, body), 0.25 * cell_size);
    }
    EXPECT_LT(std::abs(report(simulation, "penetrator_velocity")), 0.2 * speed);
    EXPECT_LT(report(simulation, "penetrator_tip_y"), -1);
}

}  // namespace
}  // namespace mpm::test
