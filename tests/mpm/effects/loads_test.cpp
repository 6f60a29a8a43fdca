#include "support.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mpm::test {
namespace {

constexpr double length = 10, modulus = 1e6, density = 1000;

/// A bar along x between rollers, held on the left; in two dimensions in plane strain.
Scene bar(ShapeFunction shape, int dimension = 2, double poissons_ratio = 0) {
    Scene scene{.name = "bar",
                .dimension = dimension,
                .grid = {.lower = {0, 0, 0}, .spacing = 0.5, .num_cells = {24, 2, 2}},
                .materials = {elastic_material("rubber", density, modulus, poissons_ratio)},
                .bodies = {{.contains = box_region({{0, 0, -1}, {length, 1, 1}}),
                            .points_per_cell = {2, 2, 2},
                            .material = "rubber"}},
                .walls = {.left = Wall::roller,
                          .bottom = Wall::roller,
                          .top = Wall::roller,
                          .back = Wall::roller,
                          .front = Wall::roller}};
    scene.shape_function = shape;
    return scene;
}

Effect traction(const std::vector<double>& pull) {
    return {"traction", {{"side", std::string("right")}, {"traction", pull}}};
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

// At rest each point has moved by x t / E, to the strain of half a cell, as the end takes effect
// where points are; and the stress is t everywhere.
void expect_pulled(Scene scene) {
    constexpr double pull = 1e4;
    std::vector<double> force(static_cast<std::size_t>(scene.dimension), 0.0);
    force[0] = pull;
    scene.effects = {traction(force), {"damping", {{"rate", 10.0}, {"until", 100.0}}}};
    Simulation simulation(scene, MPI_COMM_WORLD);
    const std::vector<double> start = gathered(simulation, "x", MPI_COMM_WORLD);
    while (simulation.time() < 6) simulation.step();
    const std::vector<double> way = gathered(simulation, "displacement_x", MPI_COMM_WORLD);
    for (std::size_t p = 0; p < way.size(); ++p)
        EXPECT_NEAR(way[p], start[p] * pull / modulus, 0.5 * scene.grid.spacing * pull / modulus);
    const std::vector<double> stress = gathered(simulation, "stress_xx", MPI_COMM_WORLD);
    EXPECT_NEAR(mean(stress), pull, 0.02 * pull);
}

TEST(Traction, pulls_a_bar_by_its_law) {
    for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::quadratic})
        expect_pulled(bar(shape));
    expect_pulled(bar(ShapeFunction::linear, 3));
}

/// A free bar with effects on it.
Scene free_bar(const std::vector<Effect>& effects) {
    Scene scene = bar(ShapeFunction::quadratic);
    scene.walls = {};
    scene.grid.lower = {-1, -1};
    scene.grid.num_cells = {26, 8, 1};
    scene.effects = effects;
    return scene;
}

// Free, the whole bar gains traction * area * time of momentum, in any direction.
TEST(Traction, gives_the_momentum_of_force_and_area) {
    Simulation simulation(free_bar({traction({30, -20})}), MPI_COMM_WORLD);
    for (int step = 0; step < 20; ++step) simulation.step();
    const Totals now = simulation.totals();
    EXPECT_NEAR(now.momentum[0], 30 * simulation.time(), 1e-9);
    EXPECT_NEAR(now.momentum[1], -20 * simulation.time(), 1e-9);
}

// After a ramp of T the momentum is that of a force since T / 2.
TEST(Traction, may_grow_in_a_time) {
    Scene scene = free_bar({traction({30, 0})});
    const double ramp = 0.05;
    scene.effects[0].parameters["ramp"] = ramp;
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < 2 * ramp) simulation.step();
    const double expected = 30 * (simulation.time() - ramp / 2);
    EXPECT_NEAR(simulation.totals().momentum[0], expected, 30 * simulation.time_step());
}

TEST(Traction, acts_on_the_outermost_points_in_its_box_only) {
    Scene scene = bar(ShapeFunction::linear);
    scene.effects = {traction({1, 0})};
    scene.effects[0].parameters["upper"] = std::vector<double>{20, 0.5};
    const Simulation simulation(scene, MPI_COMM_WORLD);
    const auto area = gathered(simulation, "traction_area", MPI_COMM_WORLD);
    const auto x = gathered(simulation, "x", MPI_COMM_WORLD);
    const auto y = gathered(simulation, "y", MPI_COMM_WORLD);
    for (std::size_t p = 0; p < area.size(); ++p)
        EXPECT_EQ(area[p], x[p] > length - 0.25 && y[p] < 0.5 ? 0.25 : 0);
}

TEST(Traction, may_act_several_times_under_names) {
    const auto on = [](const std::string& side, const std::vector<double>& pull) {
        return Parameters{{"side", side}, {"traction", pull}};
    };
    Simulation simulation(free_bar({{"east", on("right", {30, -20}), "traction"},
                                    {"traction", on("top", {0, 7})},
                                    {"west", on("left", {-10, 0}), "traction"}}),
                          MPI_COMM_WORLD);
    for (int step = 0; step < 20; ++step) simulation.step();
    const Totals now = simulation.totals();
    EXPECT_NEAR(now.momentum[0], 20 * simulation.time(), 1e-9);
    EXPECT_NEAR(now.momentum[1], (70 - 20) * simulation.time(), 1e-9);
}

TEST(Loads, are_refused_with_the_reason) {
    Scene scene = bar(ShapeFunction::linear);
    scene.effects = {traction({1, 0})};
    scene.effects[0].parameters["side"] = std::string("front");
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD), std::invalid_argument);
    scene.effects = {traction({1, 0})};
    scene.effects[0].parameters["upper"] = std::vector<double>{length - 0.2, 1};
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD), std::invalid_argument) << "no point there";
    scene.effects = {traction({1, 0}), traction({1, 0})};
    EXPECT_THROW(validate(scene), std::invalid_argument) << "the same name";
    scene.effects = {traction({1, 0})};
    scene.effects[0].kind = "traction";
    scene.effects[0].name = "two words";
    EXPECT_THROW(validate(scene), std::invalid_argument) << "no name of a column";
    scene.effects = {gravity_effect(9), gravity_effect(9)};
    scene.effects[1].name = "more";
    scene.effects[1].kind = "gravity";
    EXPECT_THROW(validate(scene), std::invalid_argument) << "a scene has one";
}

}  // namespace
}  // namespace mpm::test
