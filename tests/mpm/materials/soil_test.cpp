#include "variations.hpp"

#include <gtest/gtest.h>

namespace mpm::test {
namespace {

/// Half a column of sand of width 1 with another height than the shipped scene's 2.
Scene column(double aspect) {
    Scene scene = shipped("granular_column");
    scene.bodies.front().contains = box_region({{0, 0}, {1, aspect}});
    scene.bodies.front().bounds = everywhere;
    scene.grid.num_cells = {80, static_cast<int>(10 * aspect) + 4};
    scene.end_time = aspect > 2 ? 3 : 2;
    return scene;
}

/// How far a column of sand of half width 1 runs, by that width: to the middle of the first three
/// cells whose layer is thinner than two points on average. Single grains lie beyond, and single
/// cells are thinner or thicker by a half than their neighbours.
double run_out(const Scene& scene) {
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < scene.end_time) simulation.step();
    const int layer = 2 * scene.bodies.front().points_per_cell[0];
    std::vector<int> points(static_cast<std::size_t>(scene.grid.num_cells[0]));
    for (const double x : gathered(simulation, "x", MPI_COMM_WORLD))
        ++points[static_cast<std::size_t>(x / scene.grid.spacing)];
    std::size_t cell = 1;
    while (points[cell - 1] + points[cell] + points[cell + 1] >= 3 * layer) ++cell;
    return scene.grid.spacing * static_cast<double>(cell) - 1;
}

// Lube, Huppert, Sparks and Freundt 2005: 1.2 a for aspects below 2.3; at a = 2 their
// experiments lie between 2.40 and 3.60.
TEST(GranularColumn, runs_as_far_as_in_experiments_whatever_its_stiffness_step_and_cells) {
    const double distance = run_out(shipped("granular_column"));
    EXPECT_GT(distance, 2.4);
    EXPECT_LT(distance, 3.6);
    Scene stiff = shipped("granular_column"), slow = stiff, coarse = stiff;
    stiff.materials.front().parameters["youngs_modulus"] = 1e7;
    slow.courant_number *= 0.5;
    resize_cells(coarse, 0.125);
    for (const Scene& scene : {stiff, slow, coarse})
        EXPECT_NEAR(run_out(scene), distance, 0.1 * distance);
}

TEST(GranularColumn, runs_too_far_on_a_slippery_floor_and_not_far_with_cohesion) {
    Scene slippery = shipped("granular_column");
    slippery.walls.bottom = Wall::roller;
    slippery.grid.num_cells[0] *= 2;
    EXPECT_GT(run_out(slippery), 3.6);
    Scene sticky = shipped("granular_column");
    sticky.materials.front().parameters["cohesion"] = 3e3;
    EXPECT_LT(run_out(sticky), 2.4);
}

// The same law, and 1.9 a^(2/3) for columns that are taller; the experiments that it is fitted to
// spread by a fifth about their mean at a = 2.
TEST(GranularColumn, runs_by_the_law_of_its_aspect) {
    for (const double aspect : {0.6, 1.0, 1.5, 3.0}) {
        const double law = aspect < 2.3 ? 1.2 * aspect : 1.9 * std::pow(aspect, 2.0 / 3);
        EXPECT_NEAR(run_out(column(aspect)), law, 0.25 * law) << aspect;
    }
}

}  // namespace
}  // namespace mpm::test
