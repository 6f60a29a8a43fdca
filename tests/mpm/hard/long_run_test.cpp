// Tens of thousands of steps with default settings: whatever a body does, its energy never grows.
#include "energy.hpp"

#include <gtest/gtest.h>

#include <tuple>

namespace mpm::test {
namespace {

/// Largest growth of the energy over that before step `first`, by it.
double growth(const Scene& scene, int num_steps, std::int64_t first = 0) {
    Simulation simulation(scene, MPI_COMM_WORLD);
    double start = 0, most = -1;
    while (simulation.step_count() < num_steps) {
        const std::int64_t step = simulation.step_count();
        if (step > 200 && step % 10 != 0) {
            simulation.step();
            continue;
        }
        const Energy energy(simulation);
        simulation.step();
        const double now = energy.before_the_step();
        if (step == first) start = now;
        if (step >= first) most = std::max(most, now / start - 1);
        if (!(most < 1)) break;
    }
    return most;
}

constexpr double allowed = 1e-6;

/// A disk that spins slowly about its centre, off the nodes.
Scene free_disk(int points, double radius, ShapeFunction shape, bool has_cure) {
    const Vector centre{5.13, 5.065};
    Scene scene{.name = "disk",
                .grid = {.lower = {0, 0}, .spacing = 1, .num_cells = {10, 10}},
                .materials = {elastic_material("rubber", 1000, 1e6, 0.3)},
                .bodies = {{.contains = ball_region(centre, radius),
                            .points_per_cell = {points, points, 1},
                            .material = "rubber",
                            .velocity = velocity_field(
                                {.rotation_rate = 0.05, .rotation_centre = centre})}},
                .shape_function = shape};
    if (has_cure) scene.effects = {{"locking_cure", {}}};
    return scene;
}

class FreeDisk : public testing::TestWithParam<std::tuple<std::pair<int, double>, bool, bool>> {};

// A least mass of light nodes that did not enter their motion multiplied it by 100.
//
// An odd number of points along a cell begins with points halfway between nodes, where quadratic
// functions have other nodes on either side. They all cross in the first step, and with the cure
// their change of volume jumps (docs/energy.md).
TEST_P(FreeDisk, gains_no_energy_in_thirty_thousand_steps) {
    const auto& [size, is_quadratic, has_cure] = GetParam();
    const ShapeFunction shape = is_quadratic ? ShapeFunction::quadratic : ShapeFunction::linear;
    const bool crosses_at_once = is_quadratic && has_cure && size.first % 2 == 1;
    EXPECT_LT(
        growth(free_disk(size.first, size.second, shape, has_cure), 30000, crosses_at_once ? 1 : 0),
        allowed);
}

INSTANTIATE_TEST_SUITE_P(Points, FreeDisk,
                         testing::Combine(testing::Values(std::pair(2, 2.3), std::pair(3, 1.8),
                                                          std::pair(4, 1.5), std::pair(5, 1.3),
                                                          std::pair(6, 1.2)),
                                          testing::Bool(), testing::Bool()));

/// A block in a box of rollers.
Scene boxed(const Material& material, const Region& body, const Vector& velocity) {
    return {.name = "boxed",
            .grid = {.lower = {0, 0}, .spacing = 0.25, .num_cells = {16, 12}},
            .materials = {material},
            .bodies = {{.contains = body,
                        .points_per_cell = {3, 3, 1},
                        .material = material.name,
                        .velocity = velocity_field({.constant = velocity})}},
            .walls = {.left = Wall::roller,
                      .right = Wall::roller,
                      .bottom = Wall::roller,
                      .top = Wall::roller}};
}

TEST(LongRun, of_a_ball_between_rollers_gains_no_energy) {
    for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::quadratic}) {
        Scene scene =
            boxed(elastic_material("rubber", 1000, 1e6, 0.3), ball_region({2, 1.5}, 0.6), {3, 2});
        scene.shape_function = shape;
        EXPECT_LT(growth(scene, 30000), allowed);
    }
}

TEST(LongRun, of_clay_at_30_metres_a_second_against_a_wall_gains_no_energy) {
    const Material clay = clay_material(2e6, 5e3);
    for (const bool has_cure : {false, true}) {
        Scene scene = boxed(clay, box_region({{1, 1}, {2, 2}}), {-30, 3});
        if (has_cure) scene.effects = {{"locking_cure", {}}};
        EXPECT_LT(growth(scene, 10000), allowed) << has_cure;
    }
}

// Points parted by tension would swell without a limit of their expansion, and be hurled away when
// they meet again.
TEST(LongRun, of_soil_without_strength_gains_no_energy) {
    for (const double angle : {0.0, 10.0, 30.0})
        for (const bool has_cure : {false, true}) {
            Scene scene = boxed(soil_material("soil", 1600, 0, angle),
                                box_region({{0, 0}, {1, 1.5}}), {2, 2});
            scene.effects = {gravity_effect(9.81)};
            if (has_cure) scene.effects.push_back({"locking_cure", {}});
            EXPECT_LT(growth(scene, 10000), allowed) << angle << ' ' << has_cure;
        }
}

// Twice the momentum of a node in a step: an explicit force would grow.
TEST(LongRun, of_what_is_damped_at_any_rate_gains_no_energy) {
    for (const double rate : {1.0, 1e3, 1e6}) {
        Scene scene =
            boxed(elastic_material("rubber", 1000, 1e6, 0.3), ball_region({2, 1.5}, 0.6), {3, 2});
        scene.effects = {{"damping", {{"rate", rate}, {"until", 1e9}}}};
        EXPECT_LT(growth(scene, 300), allowed) << rate;
    }
}

}  // namespace
}  // namespace mpm::test
