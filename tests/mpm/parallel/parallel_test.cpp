#include "support.hpp"

#include <gtest/gtest.h>

namespace mpm::test {
namespace {

/// Enough for the cube to meet the floor and to leave its first ranks.
constexpr int num_steps = 40;

/// A soft cube that falls on a frictional floor, with a corner of another material.
Scene falling_cube(int dimension, ShapeFunction shape) {
    Scene scene{.name = "cube",
                .dimension = dimension,
                .grid = {.lower = {0, 0, 0}, .spacing = 0.5, .num_cells = {12, 8, 8}},
                .materials = {elastic_material("soft", 1000, 1e5, 0.3),
                              {"clay",
                               "von_mises",
                               {{"density", 2000.0},
                                {"youngs_modulus", 1e6},
                                {"poissons_ratio", 0.3},
                                {"strength", 1e3}}}},
                .bodies = {},
                .walls = {.bottom = {Wall::frictional, 0.3}},
                .shape_function = shape};
    const Vector depth{0, 0, dimension == 3 ? 1.0 : 0};
    const auto block = [&](double left, double right, const char* material) {
        return Body{
            .contains = box_region({{left, 0.5, depth[2]}, {right, 2, 2 * depth[2]}}),
            .points_per_cell = {2, 2, 2},
            .material = material,
            .velocity = velocity_field(
                {.constant = {1, -3, depth[2]}, .rotation_rate = 0.5, .rotation_centre = {2, 1}})};
    };
    scene.bodies = {block(1, 2, "soft"), block(2, 2.5, "clay")};
    scene.effects = {gravity_effect(9.81)};
    if (dimension == 3)
        scene.effects.front().parameters["acceleration"] = std::vector<double>{0, -9.81, 0.1};
    return scene;
}

void expect_serial(const Scene& scene) {
    Simulation parallel(scene, MPI_COMM_WORLD), serial(scene, MPI_COMM_SELF);
    for (int step = 0; step < num_steps; ++step) {
        parallel.step();
        serial.step();
    }
    for (const char* column : {"displacement_x", "displacement_y", "stress_yy"})
        EXPECT_LT(relative_difference(gathered(parallel, column, MPI_COMM_WORLD),
                                      gathered(serial, column, MPI_COMM_SELF)),
                  1e-12)
            << scene.dimension << column;
}

Scene with_floor(Scene scene, Wall floor) {
    scene.walls.bottom = floor;
    scene.walls.left = Wall::roller;
    return scene;
}

TEST(Decomposition, does_not_show_where_shape_functions_reach_beyond_a_wall) {
    for (const int dimension : {2, 3}) {
        const Scene cube = falling_cube(dimension, ShapeFunction::quadratic);
        expect_serial(with_floor(cube, Wall::fixed));
        expect_serial(with_floor(cube, Wall::roller));
    }
}

TEST(Decomposition, does_not_show_whatever_the_dimension_and_shape) {
    for (const int dimension : {2, 3}) {
        expect_serial(falling_cube(dimension, ShapeFunction::linear));
        expect_serial(falling_cube(dimension, ShapeFunction::quadratic));
    }
}

}  // namespace
}  // namespace mpm::test
