#include "support.hpp"
#include "words.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

namespace mpm::test {
namespace {

constexpr double g = 9.81, slope_angle = 24 * std::numbers::pi / 180, ramp = 1;
const double sine = std::sin(slope_angle), cosine = std::cos(slope_angle);
const Vector top_of_slope{0, 10};

/// A position from the top of the slope on, along it and out of it.
Vector on_slope(double along, double out) {
    return {top_of_slope[0] + along * cosine + out * sine,
            top_of_slope[1] - along * sine + out * cosine};
}

/// A block of 2 x 1 m on a plane inclined by 24 degrees, across the grid; weight is upright and
/// grows in a second.
Scene incline(double friction, double cell_size) {
    const auto cells = [&](double metres) { return static_cast<int>(metres / cell_size); };
    const Region block =
        polygon_region({on_slope(1, 0), on_slope(3, 0), on_slope(3, 1), on_slope(1, 1)});
    return {
        .name = "incline",
        .grid = {.lower = {0, 0}, .spacing = cell_size, .num_cells = {cells(22), cells(12)}},
        .materials = {elastic_material("block", 1000, 1e6, 0.3)},
        .bodies = {{.contains = block, .points_per_cell = {2, 2, 1}, .material = "block"}},
        .planes = {{"slope", top_of_slope, {sine, cosine}, friction}},
        .effects = {{"gravity", {{"acceleration", std::vector<double>{0, -g}}, {"ramp", ramp}}}}};
}

struct Slide {
    double along, out;   ///< m
    double lost_energy;  ///< by the potential energy released
};

Slide slide(const Scene& scene, double end_time) {
    Simulation simulation(scene, MPI_COMM_WORLD);
    const Totals start = simulation.totals();
    while (simulation.time() < end_time) simulation.step();
    const Totals end = simulation.totals();
    Vector way{};
    for (std::size_t a = 0; a < 2; ++a)  // to the very time, with the mean velocity
        way[a] = end.center[a] - start.center[a] -
                 end.momentum[a] / end.mass * (simulation.time() - end_time);
    const double released = start.potential_energy - end.potential_energy;
    return {way[0] * cosine - way[1] * sine, way[0] * sine + way[1] * cosine,
            (start.potential_energy - total_energy(simulation)) / released};
}

constexpr double five_seconds = 5;
const double friction = std::tan(std::numbers::pi / 12);

/// With gravity growing until T: a (t^2 / 2 - T t / 2 + T^2 / 6).
double distance(double coefficient, double t) {
    return g * (sine - coefficient * cosine) * (t * t - ramp * t + ramp * ramp / 3) / 2;
}

// The springs of the plane give way, so the block settles by some hundredths of a cell at the
// start, and comes that much further.
TEST(Plane, lets_a_block_slide_with_coulomb_friction) {
    const double expected = distance(friction, five_seconds);
    const Slide coarse = slide(incline(friction, 0.5), five_seconds);
    const Slide fine = slide(incline(friction, 0.25), five_seconds);
    Scene scene = incline(friction, 0.25);
    scene.shape_function = ShapeFunction::quadratic;
    const Slide smooth = slide(scene, five_seconds);
    EXPECT_NEAR(coarse.along, expected, 0.015 * expected);
    EXPECT_NEAR(fine.along, expected, 0.01 * expected);
    EXPECT_NEAR(smooth.along, expected, 0.005 * expected);
    EXPECT_LT(std::abs(fine.along - expected), 0.8 * std::abs(coarse.along - expected));
    EXPECT_LT(std::abs(fine.out), 0.8 * std::abs(coarse.out));
    EXPECT_NEAR(coarse.out, 0, 0.25 * 0.5);
    for (const Slide& sliding : {coarse, fine, smooth}) {
        // Of the weight's work, friction takes mu / tan, and what gravity lacked while it grew
        // counts as lost, too: its share of the way gone meanwhile, some 1 %.
        EXPECT_NEAR(sliding.lost_energy, friction / std::tan(slope_angle), 0.03);
    }
}

/// The incline with friction that is that of a number of degrees.
Scene rough_incline(ShapeFunction shape, double degrees, double cell_size, int points) {
    const double coefficient = std::tan(degrees * std::numbers::pi / 180);
    Scene scene = incline(coefficient, cell_size);
    scene.grid.num_cells[0] = static_cast<int>(8 / cell_size);
    scene.shape_function = shape;
    scene.bodies.front().points_per_cell = {points, points, 1};
    return scene;
}

constexpr std::array all_shapes{ShapeFunction::linear, ShapeFunction::quadratic};

// With 23 degrees friction bears 95 % of the pull: it must be right to 1/400.
TEST(Plane, lets_a_block_slide_right_near_the_limit) {
    constexpr double t = 3;
    for (const ShapeFunction shape : all_shapes)
        for (const auto& [degrees, cell_size, points] :
             {std::tuple(22.0, 0.25, 2), std::tuple(23.0, 0.5, 2), std::tuple(23.0, 0.25, 2),
              std::tuple(23.0, 0.125, 2), std::tuple(23.0, 0.5, 4), std::tuple(23.0, 0.25, 6)}) {
            const double expected = distance(std::tan(degrees * std::numbers::pi / 180), t);
            const Slide block = slide(rough_incline(shape, degrees, cell_size, points), t);
            EXPECT_NEAR(block.along, expected, 0.05 * expected)
                << degrees << " degrees, cells of " << cell_size << " m, " << points << " points";
        }
}

// Friction 2 % above the pull.
TEST(Plane, holds_a_block_near_the_limit) {
    for (const ShapeFunction shape : all_shapes)
        for (const double cell_size : {0.5, 0.25, 0.125}) {
            Simulation simulation(rough_incline(shape, 24.424, cell_size, 2), MPI_COMM_WORLD);
            const double start = simulation.totals().center[0];
            while (simulation.time() < 2) simulation.step();
            const double at_first = simulation.totals().center[0] - start;
            while (simulation.time() < 3) simulation.step();
            const double later = simulation.totals().center[0] - start;
            EXPECT_LT(at_first, 0.03) << "it leans, and settles";
            EXPECT_NEAR(later, at_first, 0.001) << "cells of " << cell_size << " m";
        }
}

/// A block on the bottom that gravity pulls along: on a wall, and on a plane there.
std::array<Scene, 2> on_wall_and_plane(double friction_of_both) {
    Scene by_wall = incline(friction_of_both, 0.5);
    by_wall.planes.clear();
    by_wall.walls.bottom = {Wall::frictional, friction_of_both};
    by_wall.bodies.front().contains = box_region({{1, 0}, {3, 1}});
    (*find_effect(by_wall, "gravity"))["acceleration"] = std::vector<double>{3, -g};
    Scene by_plane = by_wall;
    by_plane.walls.bottom = Wall::open;
    by_plane.planes = {{"bottom", {7, 0}, {0, 3}, friction_of_both}};
    return {by_wall, by_plane};
}

// On both a = g_x - mu g; gravity grows until T.
TEST(Plane, on_a_side_of_the_domain_slows_a_body_as_that_wall) {
    for (const double coefficient : {0.0, 0.2})
        for (const Scene& scene : on_wall_and_plane(coefficient)) {
            Simulation simulation(scene, MPI_COMM_WORLD);
            while (simulation.time() < 1.5) simulation.step();
            const Totals end = simulation.totals();
            const double speed = (3 - coefficient * g) * (simulation.time() - ramp / 2);
            EXPECT_NEAR(end.momentum[0] / end.mass, speed, 0.01 * speed);
        }
}

TEST(Plane, without_friction_has_no_column_for_it) {
    for (const double coefficient : {0.0, 0.2}) {
        const Simulation simulation(incline(coefficient, 0.5), MPI_COMM_WORLD);
        EXPECT_EQ(simulation.particles().has_column("plane_1_anchor_x"), coefficient > 0);
        EXPECT_EQ(simulation.particles().has_column("plane_1_damping"), coefficient > 0);
    }
}

/// A cube on a plane that faces up and along x and z.
Scene cube_in_space(double coefficient) {
    return {.name = "cube",
            .dimension = 3,
            .grid = {.lower = {0, 0, 0}, .spacing = 0.5, .num_cells = {12, 16, 12}},
            .materials = {elastic_material("block", 1000, 1e6, 0.3)},
            .bodies = {{.contains = common_to(half_space_region({0, 5, 0}, {-1, -2, -1}),
                                              box_region({{1, 0, 1}, {3, 6, 3}})),
                        .points_per_cell = {2, 2, 2},
                        .material = "block"}},
            .planes = {{"slope", {0, 5, 0}, {1, 2, 1}, coefficient}},
            .effects = {{"gravity", {{"acceleration", std::vector<double>{0, -g, 0}}}}},
            .courant_number = 0.1};
}

// Along a plane with the unit normal n = (1, 2, 1) / sqrt(6): a = -g (e_y - n_y n) = g (2, -2,
// 2)/6. Friction takes mu n_y g of its size, g / sqrt(3).
class PlaneInSpace : public testing::TestWithParam<double> {};

TEST_P(PlaneInSpace, guides_a_body) {
    Simulation simulation(cube_in_space(GetParam()), MPI_COMM_WORLD);
    const double initial = simulation.totals().potential_energy;
    while (simulation.time() < 1) simulation.step();
    const Totals end = simulation.totals();
    const double speed = g / 3 * (1 - GetParam() * std::numbers::sqrt2) * simulation.time();
    EXPECT_NEAR(end.momentum[0] / end.mass, speed, 0.02 * speed);
    EXPECT_NEAR(end.momentum[1] / end.mass, -speed, 0.1 * speed) << "it settles, too";
    EXPECT_NEAR(end.momentum[2] / end.mass, speed, 0.02 * speed);
    EXPECT_LT(total_energy(simulation), initial + 0.01 * (initial - end.potential_energy));
}

INSTANTIATE_TEST_SUITE_P(Friction, PlaneInSpace, testing::Values(0.0, 0.3));

TEST(Plane, that_cannot_be_is_refused_by_its_name) {
    const auto expect_plane_refused = [](const Plane& plane, const std::string& text) {
        Scene scene = incline(0.2, 0.5);
        scene.planes.front() = plane;
        expect_refused([&] { validate(scene); }, {text});
    };
    expect_plane_refused({"face", {}, {0, 0}}, "plane 'face' must have a normal");
    expect_plane_refused({"face", {}, {0, 1}, -1}, "friction of plane 'face'");
    expect_plane_refused({"face", {std::nan("")}, {0, 1}}, "finite point");
}

}  // namespace
}  // namespace mpm::test
