// Nodes that only the rims of points reach: whatever a small body is and does, its energy never
// grows.
#include "scene/light_nodes.hpp"

#include "energy.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

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
TEST(LightNodes, keeps_the_energy_of_waves_between_densities) {
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
TEST(LightNodes, keeps_bodies_of_two_densities_stable_with_the_cure) {
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

TEST(LightNodes, leave_the_energy_of_a_beam) {
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

/// A small body, and what it does. Cells are 1 m wide, waves as fast as its ratio makes them.
struct SmallBody {
    int dimension = 2;
    std::array<int, 3> points{2, 2, 2};  ///< along a cell
    double poissons_ratio = 0.45;
    ShapeFunction shape = ShapeFunction::linear;
    bool has_cure = false;
    Wall wall = Wall::open;              ///< on all sides of its box
    Vector centre{4.6, 4.3, 4.45};       ///< m
    double width = 2.5;                  ///< m; 0: one point
    double drift = 0.003, turn = 0.003;  ///< speeds, of its centre and its sides, by the waves'
};

void PrintTo(const SmallBody& body, std::ostream* out) {
    *out << body.dimension << "-D, points " << body.points[0] << ' ' << body.points[1] << ' '
         << body.points[2] << ", ratio " << body.poissons_ratio << ", shape "
         << static_cast<int>(body.shape) << ", cure " << body.has_cure << ", wall "
         << body.wall.kind << ", width " << body.width << ", drift " << body.drift << ", turn "
         << body.turn;
}

Scene scene_of(const SmallBody& body) {
    const double nu = body.poissons_ratio;
    const double waves = std::sqrt(1000 * (1 - nu) / ((1 + nu) * (1 - 2 * nu)));
    const bool has_depth = body.dimension == 3;
    Vector lower{}, upper{}, nearest{};
    for (std::size_t a = 0; a < static_cast<std::size_t>(body.dimension); ++a) {
        lower[a] = body.centre[a] - body.width / 2;
        upper[a] = body.centre[a] + body.width / 2;
        const double spacing = 1.0 / body.points[a];
        nearest[a] = (std::floor(body.centre[a] / spacing) + 0.5) * spacing;
    }
    const Vector drift{0.8 * body.drift * waves, -0.53 * body.drift * waves,
                       has_depth ? 0.28 * body.drift * waves : 0};
    Scene scene{.name = "small body",
                .dimension = body.dimension,
                .grid = {.lower = {}, .spacing = 1, .num_cells = {9, 9, has_depth ? 9 : 0}},
                .materials = {elastic_material("rubber", 1000, 1e6, nu)},
                .bodies = {{.contains = body.width > 0 ? box_region({lower, upper})
                                                       : ball_region(nearest, 1e-3),
                            .points_per_cell = body.points,
                            .material = "rubber"}},
                .walls = {body.wall, body.wall, body.wall, body.wall},
                .shape_function = body.shape,
                .end_time = 1e9};
    const double rate = body.width > 0 ? 2 * body.turn * waves / body.width : 0;
    scene.bodies.front().velocity =
        velocity_field({.constant = drift, .rotation_rate = rate, .rotation_centre = body.centre});
    if (has_depth) scene.walls.back = scene.walls.front = body.wall;
    if (!has_depth) scene.bodies.front().points_per_cell[2] = 1;
    if (body.has_cure) scene.effects = {{"locking_cure", {}}};
    return scene;
}

/// Largest energy within some steps, by that at the start, while no point has left.
double most_energy(const SmallBody& body, int num_steps) {
    Simulation simulation(scene_of(body), MPI_COMM_WORLD);
    double start = 0, most = 0;
    while (simulation.step_count() < num_steps && most < 2) {
        const std::int64_t step = simulation.step_count();
        if (step > 50 && step % 7 != 0) {
            simulation.step();
            continue;
        }
        if (simulation.totals().num_points < simulation.num_points()) break;
        const Energy energy(simulation);
        simulation.step();
        if (step == 0) start = energy.before_the_step();
        most = std::max(most, energy.before_the_step() / start);
    }
    return most;
}

TEST(LightNodes, have_the_least_weights_of_the_documented_table) {
    const auto rule = [](int dimension, double ratio, ShapeFunction shape, bool has_cure) {
        return rule_for(scene_of({.dimension = dimension,
                                  .poissons_ratio = ratio,
                                  .shape = shape,
                                  .has_cure = has_cure}));
    };
    constexpr auto linear = ShapeFunction::linear, quadratic = ShapeFunction::quadratic;
    // w (1 - w) = C^2 / 2 max(2 G, D lambda + 2 G) / (rho c^2), which is 0.08 at ratio 0.
    EXPECT_NEAR(rule(2, 0, linear, false).least_weight, 0.0877, 0.002);
    EXPECT_NEAR(rule(3, 0.45, linear, false).least_weight, 0.302, 0.002);
    EXPECT_NEAR(rule(3, 0.499, linear, false).courant_number, 0.385, 0.001);
    EXPECT_NEAR(rule(3, 0.45, linear, true).courant_number, 0.365, 0.001);
    EXPECT_EQ(rule(2, 0.499, quadratic, false).least_weight, 0);
    EXPECT_NEAR(rule(2, 0.3, quadratic, true).least_weight, 0.05, 0.005);
    EXPECT_NEAR(rule(3, 0.499, quadratic, true).courant_number, 0.312, 0.001);
}

constexpr double round_off = 1e-4;

// A rule that reasons along one axis, and with a limit of 4 in place of 2, multiplies these by up
// to 3,000.
TEST(LightNodes, of_one_point_give_no_energy) {
    for (const int dimension : {2, 3})
        for (const double ratio : {0.0, 0.3, 0.4, 0.49, 0.499})
            for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::quadratic})
                for (const bool has_cure : {false, true}) {
                    const SmallBody body{.dimension = dimension,
                                         .poissons_ratio = ratio,
                                         .shape = shape,
                                         .has_cure = has_cure,
                                         .width = 0};
                    EXPECT_LT(most_energy(body, 2000), 1 + round_off)
                        << testing::PrintToString(body);
                }
}

// The first two have gained 10 to 13 times their energy, the others 80 to 700 times.
TEST(LightNodes, of_small_blocks_give_no_energy) {
    constexpr auto quadratic = ShapeFunction::quadratic;
    const Wall frictional(Wall::frictional, 0.3);
    for (const SmallBody& body :
         {SmallBody{.points = {1, 1, 1}, .drift = 0.01, .turn = 0.01},
          SmallBody{.dimension = 3, .points = {1, 1, 1}, .poissons_ratio = 0.49},
          SmallBody{.points = {1, 6, 1},
          .poissons_ratio = 0,
          .shape = quadratic,
          .has_cure = true,
          .wall = Wall::roller},
          SmallBody{.points = {1, 6, 1},
          .poissons_ratio = 0,
          .shape = quadratic,
          .has_cure = true,
          .wall = frictional},
          SmallBody{.dimension = 3,
          .points = {1, 2, 2},
          .poissons_ratio = 0.3,
          .shape = quadratic,
          .has_cure = true,
          .wall = Wall::roller}})
        EXPECT_LT(most_energy(body, 3000), 1.001) << testing::PrintToString(body);
}

SmallBody random_body(std::mt19937& random) {
    const auto number = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    const auto one_of = [&](auto... choices) {
        const std::array all{choices...};
        return all[static_cast<std::size_t>(number(0, static_cast<double>(all.size())))];
    };
    SmallBody body{.dimension = one_of(2, 2, 3)};
    for (int& points : body.points)
        points = 1 + static_cast<int>(number(0, body.dimension == 3 ? 3 : 6));
    body.poissons_ratio = one_of(0.0, 0.2, 0.3, 0.4, 0.45, 0.49, 0.499);
    body.shape = one_of(ShapeFunction::linear, ShapeFunction::quadratic);
    body.has_cure = one_of(false, true);
    body.wall = one_of(Wall(Wall::open), Wall(Wall::roller), Wall(Wall::frictional, 0.3));
    for (double& centre : body.centre) centre = number(3.5, 5.5);
    body.width = one_of(0.0, 1.3, 1.7, 2.5, 3.2);
    body.drift = one_of(0.003, 0.01, 0.03, 0.1);
    body.turn = one_of(0.003, 0.01, 0.03, 0.1);
    return body;
}

// MPM_RANDOM_SCENES=300 for more. Quadratic functions with the cure gain a little in the first
// steps of a fast body: points that cross take another centre's change of volume.
TEST(LightNodes, of_random_small_bodies_give_no_energy) {
    const char* const asked = std::getenv("MPM_RANDOM_SCENES");
    const int num_scenes = asked != nullptr ? std::atoi(asked) : 40;
    std::mt19937 random(1);
    double worst = 0;
    for (int k = 0; k < num_scenes; ++k) {
        const SmallBody body = random_body(random);
        const double most = most_energy(body, 1500);
        EXPECT_LT(most, 1.005) << testing::PrintToString(body);
        worst = std::max(worst, most);
    }
    std::printf("most energy of %d random bodies by that at the start: %.5f\n", num_scenes, worst);
}

}  // namespace
}  // namespace mpm::test
