// Walls that move along themselves, with all shape functions.
#include "support.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mpm::test {
namespace {

constexpr ShapeFunction all_shapes[] = {ShapeFunction::linear, ShapeFunction::quadratic,
                                        ShapeFunction::gimp};

/// A layer of soil, 1 m high, on a base that shakes by 1 mm as long waves do, and the motion of a
/// wave that has always stood in it: u = U sin(w t) cos(k (H - y)) / cos(k H), k H = 0.8.
struct Shaken {
    static constexpr double way = 1e-3, phase = 0.8, shear_speed = 31.622776601683793;
    static constexpr double rate = phase * shear_speed;

    static double share(double y) { return std::cos(phase * (1 - y)) / std::cos(phase); }

    static Scene scene(ShapeFunction shape, double cell_size) {
        const int cells = static_cast<int>(std::lround(1 / cell_size));
        const auto velocity = [](const Vector& at) {
            return Vector{rate * way * share(at[1]), 0, 0};
        };
        Scene scene{
            .name = "shaken",
            .grid = {.lower = {-1, 0}, .spacing = cell_size, .num_cells = {18 * cells, 2 * cells}},
            .materials = {elastic_material("soil", 1000, 2e6, 0)},
            .bodies = {{.contains = box_region({{0, 0}, {16, 1}}),
                        .material = "soil",
                        .velocity = velocity}},
            .walls = {.bottom = Wall::fixed},
            .shape_function = shape};
        Motion& motion = scene.walls.bottom.motion;
        motion.direction = {1, 0};
        for (double time = 0; time < 2 / rate; time += 0.05 / rate) {
            motion.times.push_back(time);
            motion.speeds.push_back(rate * way * std::cos(rate * time));
        }
        return scene;
    }

    /// Largest difference from the wave, half way along the layer, by the way of the base.
    static double error(ShapeFunction shape, double cell_size) {
        Simulation simulation(scene(shape, cell_size), MPI_COMM_WORLD);
        while (simulation.time() < 0.5 * std::numbers::pi / rate) simulation.step();
        const auto x = gathered(simulation, "x", MPI_COMM_WORLD);
        const auto y = gathered(simulation, "y", MPI_COMM_WORLD);
        const auto found = gathered(simulation, "displacement_x", MPI_COMM_WORLD);
        double error = 0;
        for (std::size_t p = 0; p < x.size(); ++p)
            if (std::abs(x[p] - 8) < 0.1)
                error = std::max(error, std::abs(found[p] / way -
                                                 share(y[p]) * std::sin(rate * simulation.time())));
        return error;
    }
};

// Of first order in the size of cells, by a rise from 1 at the base to 1.435 at the top.
TEST(MovingWall, shakes_a_layer_as_its_law_says) {
    for (const ShapeFunction shape : all_shapes) EXPECT_LT(Shaken::error(shape, 0.1), 0.03);
    EXPECT_LT(Shaken::error(ShapeFunction::linear, 0.05), 0.01);
}

/// A block of 2 x 1 m on a belt of 3 m/s.
Scene block_on_belt(ShapeFunction shape) {
    Scene scene{.name = "belt",
                .grid = {.lower = {0, 0}, .spacing = 0.25, .num_cells = {40, 8}},
                .materials = {elastic_material("block", 1000, 1e6, 0.3)},
                .bodies = {{.contains = box_region({{1, 0}, {3, 1}}), .material = "block"}},
                .walls = {.bottom = {Wall::frictional, 0.3}},
                .effects = {gravity_effect(10)},
                .shape_function = shape};
    scene.walls.bottom.motion = {{2, 0}, {0}, {3}};
    return scene;
}

// It takes a block along with friction * g, up to its speed.
TEST(MovingWall, takes_a_block_along_by_friction) {
    for (const ShapeFunction shape : all_shapes) {
        Scene scene = block_on_belt(shape);
        Simulation simulation(scene, MPI_COMM_WORLD);
        const double start = simulation.totals().center[0];
        while (simulation.time() < 0.5) simulation.step();
        const Totals early = simulation.totals();
        EXPECT_NEAR(early.momentum[0] / early.mass, 3 * simulation.time(), 0.02);
        while (simulation.time() < 2) simulation.step();
        const Totals late = simulation.totals();
        EXPECT_NEAR(late.momentum[0] / late.mass, 3, 0.02);
        EXPECT_NEAR(late.center[0] - start, 1.5 + 3 * (simulation.time() - 1), 0.03);
    }
}

// The base runs under the roller, into which it must draw nothing.
TEST(MovingWall, leaves_what_another_wall_holds) {
    Scene scene = block_on_belt(ShapeFunction::quadratic);
    scene.bodies.front().contains = box_region({{0, 0}, {2, 1}});
    scene.walls = {.left = Wall::roller, .bottom = Wall::fixed};
    scene.walls.bottom.motion = {{-1, 0}, {0}, {1}};
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < 0.2) simulation.step();
    for (const double x : gathered(simulation, "x", MPI_COMM_WORLD)) EXPECT_GT(x, 0.03);
}

TEST(MovingWall, moves_as_it_is_told_beside_local_damping) {
    constexpr double speed = 0.5;
    Scene scene = block_on_belt(ShapeFunction::linear);
    scene.bodies.front().contains = box_region({{1, 0}, {7, 1}});
    scene.walls.bottom = Wall::fixed;
    scene.walls.bottom.motion = {{1, 0}, {0}, {speed}};
    scene.effects = {{"local_damping", {{"fraction", 0.7}, {"until", 10.0}}}};
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < 0.6) simulation.step();
    const auto y = gathered(simulation, "y", MPI_COMM_WORLD);
    const auto way = gathered(simulation, "displacement_x", MPI_COMM_WORLD);
    double sum = 0, num_lowest = 0;
    for (std::size_t p = 0; p < y.size(); ++p) {
        if (y[p] > 0.1) continue;
        sum += way[p];
        ++num_lowest;
    }
    EXPECT_NEAR(sum / num_lowest, speed * simulation.time(), 0.01 * speed * simulation.time());
}

TEST(MovingWall, acts_the_same_between_ranks) {
    for (const double friction : {0.0, 0.3}) {
        Scene scene = Shaken::scene(ShapeFunction::quadratic, 0.25);
        if (friction > 0) scene.walls.bottom.kind = Wall::frictional;
        scene.walls.bottom.friction = friction;
        scene.effects = {gravity_effect(10)};
        Simulation parallel(scene, MPI_COMM_WORLD), serial(scene, MPI_COMM_SELF);
        const auto cut = [](Positions, MPI_Comm comm) { return layers(size_of(comm)); };
        parallel.rebalance(cut);
        for (int step = 0; step < 30; ++step) {
            parallel.step();
            serial.step();
        }
        expect_same_motion(serial, parallel);
    }
}

TEST(MovingWall, that_cannot_be_is_refused_by_its_name) {
    const auto expect_refused = [](const Wall& wall, const Motion& motion,
                                   const std::string& text) {
        Scene scene = block_on_belt(ShapeFunction::linear);
        scene.walls.bottom = wall;
        scene.walls.bottom.motion = motion;
        try {
            validate(scene);
            ADD_FAILURE() << text;
        } catch (const std::invalid_argument& error) {
            EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
        }
    };
    expect_refused(Wall::fixed, {{0, 1}, {0}, {1}}, "the wall 'bottom' must move along itself");
    expect_refused(Wall::fixed, {{0, 0}, {0}, {1}}, "a direction that is not zero");
    expect_refused(Wall::fixed, {{1, 0}, {0, 1}, {1}}, "a value for each of the 'times'");
    expect_refused(Wall::roller, {{1, 0}, {0}, {1}}, "must be fixed or have friction");
    expect_refused({Wall::frictional, 0}, {{1, 0}, {0}, {1}}, "must be fixed or have friction");
}

}  // namespace
}  // namespace mpm::test
