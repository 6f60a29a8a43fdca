// Walls that points are thrown against, with all shape functions.
#include "support.hpp"

namespace mpm::test {
namespace {

constexpr ShapeFunction all_shapes[] = {ShapeFunction::linear, ShapeFunction::quadratic};

/// Soil without strength in tension that fills a corner of the domain, thrown into it.
Scene thrown_into_corner(ShapeFunction shape, double friction) {
    const Wall wall{Wall::frictional, friction};
    Material sand = soil_material("sand", 1600, 0, 31);
    sand.parameters["most_expansion"] = 1.5;
    return {.name = "thrown",
            .grid = {.lower = {0, 0}, .spacing = 0.1, .num_cells = {60, 24}},
            .materials = {sand},
            .bodies = {{.contains = box_region({{0.4, 0.3}, {1.2, 1.1}}),
                        .material = "sand",
                        .velocity = velocity_field({.constant = {-4, -3}})}},
            .walls = {.left = wall, .right = wall, .bottom = wall, .top = wall},
            .effects = {gravity_effect(9.81)},
            .shape_function = shape,
            .courant_number = 0.4};
}

/// A column of that sand, which collapses on the bottom.
Scene collapsing(ShapeFunction shape, double friction) {
    Scene scene = thrown_into_corner(shape, friction);
    scene.bodies.front().contains = box_region({{0, 0}, {1, 2}});
    scene.bodies.front().points_per_cell = {3, 3, 1};
    scene.bodies.front().velocity = {};
    return scene;
}

TEST(FrictionalWall, lets_no_point_through) {
    for (const ShapeFunction shape : all_shapes)
        for (const double friction : {0.0, 0.5}) {
            SCOPED_TRACE(friction);
            Simulation simulation(collapsing(shape, friction), MPI_COMM_WORLD);
            const Totals start = simulation.totals();
            while (simulation.time() < 0.45) ASSERT_NO_THROW(simulation.step());
            const Totals end = simulation.totals();
            EXPECT_LT(end.kinetic_energy + end.potential_energy,
                      start.kinetic_energy + start.potential_energy);
        }
}

TEST(FrictionalWall, acts_the_same_between_ranks_along_it) {
    for (const ShapeFunction shape : all_shapes) {
        const Scene scene = thrown_into_corner(shape, 0.5);
        Simulation parallel(scene, MPI_COMM_WORLD), serial(scene, MPI_COMM_SELF);
        const auto cut = [](Positions, MPI_Comm comm) { return layers(size_of(comm)); };
        parallel.rebalance(cut);
        while (serial.time() < 0.12) {
            parallel.step();
            serial.step();
        }
        expect_same_motion(serial, parallel);
    }
}

constexpr double steep = 24 * std::numbers::pi / 180, ramp = 1, g = 9.81;

/// A block of 2 x 1 m on the bottom, whose weight pulls it along as on a slope of 24 degrees and
/// grows in a second.
Scene sliding(ShapeFunction shape, double friction, double cell_size, int points = 2) {
    const auto cells = [&](double metres) { return static_cast<int>(metres / cell_size); };
    return {.name = "sliding",
            .grid = {.lower = {0, 0}, .spacing = cell_size, .num_cells = {cells(10), cells(2)}},
            .materials = {elastic_material("block", 1000, 1e6, 0.3)},
            .bodies = {{.contains = box_region({{1, 0}, {3, 1}}),
                        .points_per_cell = {points, points, 1},
                        .material = "block"}},
            .walls = {.bottom = {Wall::frictional, friction}},
            .effects = {{"gravity",
                         {{"acceleration",
                           std::vector<double>{g * std::sin(steep), -g * std::cos(steep)}},
                          {"ramp", ramp}}}},
            .shape_function = shape};
}

/// Way along the wall in a time, as far as the mean velocity tells between two steps.
double way(const Scene& scene, double end_time) {
    Simulation simulation(scene, MPI_COMM_WORLD);
    const double start = simulation.totals().center[0];
    while (simulation.time() < end_time) simulation.step();
    const Totals end = simulation.totals();
    return end.center[0] - start - end.momentum[0] / end.mass * (simulation.time() - end_time);
}

// Rigid ground makes the elastic block flutter, and slide up to 2.5 times as far as it should.
// With gravity growing until T: a (t^2 / 2 - T t / 2 + T^2 / 6).
TEST(FrictionalWall, lets_a_block_slide_right_near_the_limit) {
    constexpr double t = 3;
    for (const ShapeFunction shape : all_shapes)
        for (const auto& [angle, cell_size, points] :
             {std::tuple(22, 0.5, 2), std::tuple(22, 0.125, 2), std::tuple(23, 0.5, 2),
              std::tuple(23, 0.25, 2), std::tuple(23, 0.125, 2), std::tuple(23, 0.25, 6)}) {
            const double friction = std::tan(angle * std::numbers::pi / 180);
            const double expected = g * (std::sin(steep) - friction * std::cos(steep)) *
                                    (t * t - ramp * t + ramp * ramp / 3) / 2;
            EXPECT_NEAR(way(sliding(shape, friction, cell_size, points), t), expected,
                        0.05 * expected)
                << angle << " degrees, cells of " << cell_size << " m, " << points << " points";
        }
}

TEST(FrictionalWall, holds_a_block_near_the_limit) {
    for (const ShapeFunction shape : all_shapes)
        for (const auto& [friction, cell_size] :
             {std::pair(1.02 * std::tan(steep), 0.5), std::pair(1.02 * std::tan(steep), 0.25),
              std::pair(1.02 * std::tan(steep), 0.125),
              std::pair(std::tan(25 * std::numbers::pi / 180), 0.25)}) {
            Simulation simulation(sliding(shape, friction, cell_size), MPI_COMM_WORLD);
            const double start = simulation.totals().center[0];
            while (simulation.time() < 3) simulation.step();
            const double at_first = simulation.totals().center[0] - start;
            while (simulation.time() < 4) simulation.step();
            EXPECT_LT(at_first, 0.03) << "it leans, and settles";
            EXPECT_NEAR(simulation.totals().center[0] - start, at_first, 0.001);
        }
}

// Points sink deeper than they begin above the wall: there is ground behind it.
TEST(FrictionalWall, that_gives_way_keeps_points_in_the_grid) {
    for (const ShapeFunction shape : all_shapes) {
        Scene scene = sliding(shape, 0.6, 0.5);
        scene.materials = {elastic_material("block", 1000, 2e5, 0.3)};
        scene.bodies.front().points_per_cell = {6, 6, 1};
        Simulation simulation(scene, MPI_COMM_WORLD);
        EXPECT_NO_THROW(while (simulation.time() < 2) simulation.step());
        const std::vector<double> y = gathered(simulation, "y", MPI_COMM_WORLD);
        EXPECT_LT(*std::ranges::min_element(y), 0);
    }
}

// A point of six along a side of a cell stands for as many above it, which a thin layer has not.
TEST(FrictionalWall, gives_a_thin_layer_no_energy) {
    for (const ShapeFunction shape : all_shapes) {
        Scene scene = sliding(shape, 0.3, 0.5, 6);
        scene.bodies.front().contains = box_region({{1, 1}, {3, 1 + 0.5 / 6}});
        scene.bodies.front().velocity = velocity_field({.constant = {0, -1}});
        scene.effects.clear();
        Simulation simulation(scene, MPI_COMM_WORLD);
        const double start = simulation.totals().kinetic_energy;
        while (simulation.time() < 2) {
            simulation.step();
            ASSERT_LE(simulation.totals().kinetic_energy, 1.001 * start);
        }
        const Totals end = simulation.totals();
        EXPECT_GT(end.center[1], 0);
        EXPECT_GE(end.momentum[1], 0) << "the wall has stopped it";
    }
}

// Springs of the wall go with the points to their next ranks.
TEST(FrictionalWall, acts_the_same_with_a_rebalance_at_every_step) {
    for (const ShapeFunction shape : all_shapes) {
        const Scene scene = sliding(shape, 0.3, 0.25);
        Simulation parallel(scene, MPI_COMM_WORLD), serial(scene, MPI_COMM_SELF);
        for (int step = 0; step < 200; ++step) {
            std::vector<double> cuts;
            for (int k = 1; k < size_of(MPI_COMM_WORLD); ++k)
                cuts.push_back(0.7 + 0.6 * k + 0.15 * (step % 5));
            parallel.rebalance([&](Positions, MPI_Comm) { return between_cuts(cuts); });
            parallel.step();
            serial.step();
        }
        expect_same_motion(serial, parallel);
    }
}

// The disk flies out through the left side, a second one stays.
TEST(OpenSide, lets_points_leave_on_any_number_of_ranks) {
    Scene scene = flying_disk();
    Body resting = scene.bodies.front();
    resting.contains = ball_region({15, 4}, 2);
    resting.velocity = {};
    scene.bodies.front().velocity = velocity_field({.constant = {-8, 0}});
    scene.bodies.push_back(resting);
    Simulation simulation(scene, MPI_COMM_WORLD);
    const Totals start = simulation.totals();
    std::int64_t before = start.num_points;
    while (simulation.time() < 1.2) {
        simulation.step();
        const std::int64_t now = simulation.totals().num_points;
        ASSERT_LE(now, before);
        // The rear of the disk is 6 m from the side, its front 2 m.
        if (simulation.time() < 0.24) {
            ASSERT_EQ(now, start.num_points);
        }
        before = now;
    }
    const Totals end = simulation.totals();
    EXPECT_EQ(end.num_points, start.num_points / 2);
    EXPECT_NEAR(end.mass, start.mass / 2, 1e-9 * start.mass);
    EXPECT_NEAR(end.center[0], 15, 1e-9);
    EXPECT_EQ(simulation.num_points(), start.num_points);
}

// Points just above a roller, so fast that a step carries them beyond it: nothing is lost, and no
// energy comes in.
TEST(Roller, turns_stray_points_back) {
    for (const ShapeFunction shape : all_shapes) {
        Scene scene = flying_disk();
        scene.walls = {Wall::roller, Wall::roller, Wall::roller, Wall::roller};
        scene.shape_function = shape;
        // Stretched by 10 % in the first step.
        scene.bodies.front().velocity = [](const Vector& at) {
            return Vector{40 * (at[0] - 4), 40 * (at[1] - 4), 0};
        };
        Simulation simulation(scene, MPI_COMM_WORLD);
        const Totals start = simulation.totals();
        while (simulation.time() < 2) simulation.step();
        const Totals end = simulation.totals();
        EXPECT_EQ(end.num_points, start.num_points);
        EXPECT_LT(end.kinetic_energy + end.strain_energy, start.kinetic_energy);
    }
}

}  // namespace
}  // namespace mpm::test
