#include "effects/time_function.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mpm::test {
namespace {

TEST(TimeFunction, follows_straight_lines_and_sums_them_up) {
    const TimeFunction f({1, 2, 4}, {0, 2, -2}, "here");
    EXPECT_EQ(f.at(0), 0);
    EXPECT_EQ(f.at(1.5), 1);
    EXPECT_EQ(f.at(3), 0);
    EXPECT_EQ(f.at(9), -2);
    EXPECT_EQ(f.integral(1), 0);
    EXPECT_EQ(f.integral(1.5), 0.25);
    EXPECT_EQ(f.integral(3), 2);
    EXPECT_EQ(f.integral(4), 1);
    EXPECT_EQ(f.integral(6), -3);
    EXPECT_EQ(TimeFunction({0}, {3}, "here").integral(2), 6);
    for (const double first : {-1, 1}) {
        const TimeFunction constant({first, first + 2}, {3, 3}, "here");
        EXPECT_EQ(constant.integral(0), 0);
        EXPECT_EQ(constant.integral(2), 6);
    }
    EXPECT_THROW(TimeFunction({0, 1}, {3}, "here"), std::invalid_argument);
    EXPECT_THROW(TimeFunction({1, 1}, {3, 4}, "here"), std::invalid_argument);
}

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
    EXPECT_LT(simulation.max_speed(), 1e-5);
    const std::vector<double> way = gathered(simulation, "displacement_x", MPI_COMM_WORLD);
    for (std::size_t p = 0; p < way.size(); ++p)
        EXPECT_NEAR(way[p], start[p] * pull / modulus, 0.5 * scene.grid.spacing * pull / modulus);
    const std::vector<double> stress = gathered(simulation, "stress_xx", MPI_COMM_WORLD);
    EXPECT_NEAR(mean(stress), pull, 0.02 * pull);
}

TEST(Traction, pulls_a_bar_by_its_law) {
    for (const ShapeFunction shape :
         {ShapeFunction::linear, ShapeFunction::quadratic, ShapeFunction::gimp})
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
    Scene scene = free_bar({traction({30, -20})});
    scene.effects[0].parameters["times"] = std::vector<double>{0, 0.1};
    scene.effects[0].parameters["shares"] = std::vector<double>{1, 1};
    Simulation simulation(scene, MPI_COMM_WORLD);
    for (int step = 0; step < 20; ++step) simulation.step();
    const Totals now = simulation.totals();
    EXPECT_NEAR(now.momentum[0], 30 * simulation.time(), 1e-9);
    EXPECT_NEAR(now.momentum[1], -20 * simulation.time(), 1e-9);
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

Effect piston(double speed, double start = length) {
    return {"moving_plane",
            {{"point", std::vector<double>{start, 0}},
             {"normal", std::vector<double>{-1, 0}},
             {"times", std::vector<double>{0, 0.5}},
             {"speeds", std::vector<double>{0, speed}}}};
}

/// Mean of a column over the points that start in the middle half of the bar, away from its ends.
double mean_in_middle(const Simulation& simulation, const std::string& column) {
    const std::vector<double> x = gathered(simulation, "x", MPI_COMM_WORLD);
    const std::vector<double> way = gathered(simulation, "displacement_x", MPI_COMM_WORLD);
    const std::vector<double> values = gathered(simulation, column, MPI_COMM_WORLD);
    std::vector<double> middle;
    for (std::size_t p = 0; p < x.size(); ++p)
        if (std::abs(x[p] - way[p] - 0.5 * length) < 0.25 * length) middle.push_back(values[p]);
    return mean(middle);
}

// A piston that moves slowly: uniaxial strain, ln(1 - way / L), and the stress of the modulus
// E (1 - nu) / ((1 + nu) (1 - 2 nu)) that a rate of stress by rate of strain sums up to.
void expect_pushed(const Scene& bare, double last_way, double tolerance) {
    constexpr double nu = 0.3, speed = 0.1;
    const double stiffness = modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    Scene scene = bare;
    scene.effects = {piston(speed), {"damping", {{"rate", 5.0}, {"until", 1.0}}}};
    Simulation simulation(scene, MPI_COMM_WORLD);
    // In several phases of the piston's way through its cells.
    for (double way = 0.1; way < last_way; way += 0.15) {
        while (speed * (simulation.time() - 0.25) < way) simulation.step();
        const double now = speed * (simulation.time() - 0.25);
        const double expected = stiffness * std::log(1 - now / length);
        EXPECT_NEAR(mean_in_middle(simulation, "stress_xx"), expected,
                    tolerance * std::abs(expected))
            << way;
        EXPECT_NEAR(mean_in_middle(simulation, "stress_yy"), nu / (1 - nu) * expected,
                    tolerance * nu / (1 - nu) * std::abs(expected))
            << way;
    }
}

TEST(MovingPlane, strains_a_column_as_a_piston_does) {
    expect_pushed(bar(ShapeFunction::quadratic, 2, 0.3), 1.2, 0.04);
    expect_pushed(bar(ShapeFunction::gimp, 2, 0.3), 1.2, 0.04);
    // Before points cross cells.
    expect_pushed(bar(ShapeFunction::linear, 2, 0.3), 0.2, 0.05);
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

// Two pistons press a free bar from both ends: it stays where it is, and each does half of it.
TEST(MovingPlane, may_act_several_times_under_names) {
    constexpr double speed = 0.05;
    Effect west = piston(speed, 0);
    west.parameters["normal"] = std::vector<double>{1, 0};
    west.name = "west";
    west.kind = "moving_plane";
    Scene scene = bar(ShapeFunction::quadratic);
    scene.walls.left = Wall::open;
    scene.grid.lower[0] = -1;
    scene.grid.num_cells[0] = 26;
    scene.effects = {piston(speed), west, {"damping", {{"rate", 5.0}, {"until", 1.0}}}};
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < 2.25) simulation.step();
    const double way = 2 * speed * (simulation.time() - 0.25);
    const double expected = modulus * std::log(1 - way / length);
    EXPECT_NEAR(mean_in_middle(simulation, "stress_xx"), expected, 0.05 * std::abs(expected));
    EXPECT_NEAR(simulation.totals().center[0], 0.5 * length, 0.001);
}

/// Way of a short stiff block on a plane that moves along by 0.1 m, to a speed of -1 m/s.
double shaken(double friction, double& momentum) {
    Scene scene{.name = "shaken",
                .grid = {.lower = {-2, -1}, .spacing = 0.25, .num_cells = {24, 12}},
                .materials = {elastic_material("stone", density, 1e8, 0.2)},
                .bodies = {{.contains = box_region({{0, 0}, {1, 0.5}}),
                            .points_per_cell = {2, 2, 1},
                            .material = "stone"}}};
    scene.effects = {gravity_effect(10),
                     {"moving_plane",
                      {{"point", std::vector<double>{0, 0}},
                       {"normal", std::vector<double>{0, 1}},
                       {"direction", std::vector<double>{1, 0}},
                       {"friction", friction},
                       {"times", std::vector<double>{0, 0.2, 0.4}},
                       {"speeds", std::vector<double>{0, 1, -1}}}}};
    Simulation simulation(scene, MPI_COMM_WORLD);
    const double start = simulation.totals().center[0];
    while (simulation.time() < 0.4) simulation.step();
    momentum = simulation.totals().momentum[0];
    return simulation.totals().center[0] - start;
}

// By friction alone.
TEST(MovingPlane, carries_what_stands_on_it_by_friction) {
    double momentum = 0;
    EXPECT_NEAR(shaken(100, momentum), 0.1, 0.01);
    EXPECT_NEAR(momentum, -500, 50);
    EXPECT_NEAR(shaken(0, momentum), 0, 1e-12);
}

TEST(Loads, are_refused_with_the_reason) {
    Scene scene = bar(ShapeFunction::linear);
    scene.effects = {traction({1, 0})};
    scene.effects[0].parameters["side"] = std::string("front");
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD), std::invalid_argument);
    scene.effects = {traction({1, 0})};
    scene.effects[0].parameters["upper"] = std::vector<double>{length - 0.2, 1};
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD), std::invalid_argument) << "no point there";
    scene.effects = {piston(1, 0.8 * length)};
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD), std::invalid_argument) << "in the bar";
    scene.effects = {piston(1)};
    scene.effects[0].parameters["times"] = std::vector<double>{0, 0};
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD), std::invalid_argument);
    scene.effects[0].parameters["times"] = std::vector<double>{};
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD), std::invalid_argument);
    scene.effects = {piston(1)};
    scene.effects[0].parameters["normal"] = std::vector<double>{0, 0};
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD), std::invalid_argument);
    scene.effects = {piston(1), piston(1)};
    EXPECT_THROW(validate(scene), std::invalid_argument) << "the same name";
    scene.effects = {piston(1)};
    scene.effects[0].kind = "moving_plane";
    scene.effects[0].name = "two words";
    EXPECT_THROW(validate(scene), std::invalid_argument) << "no name of a column";
    scene.effects[0].name = "plane_1";
    scene.planes = {{"ground", {0, 0}, {0, 1}, {Wall::frictional, 0.3}}};
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD), std::invalid_argument) << "a plane's columns";
    scene.planes.clear();
    scene.effects = {gravity_effect(9), gravity_effect(9)};
    scene.effects[1].name = "more";
    scene.effects[1].kind = "gravity";
    EXPECT_THROW(validate(scene), std::invalid_argument) << "a scene has one";
}

}  // namespace
}  // namespace mpm::test
