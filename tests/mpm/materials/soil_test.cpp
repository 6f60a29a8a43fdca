#include "scene_file/scene_file_mpi.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

namespace mpm::test {
namespace {

Scene shipped(const std::string& name) {
    return read_scene(RRCB_SCENES "/" + name + ".yaml", MPI_COMM_WORLD).scene;
}

/// The largest of a column.
double largest(const Simulation& simulation, const std::string& column) {
    const std::vector<double> values = gathered(simulation, column, MPI_COMM_WORLD);
    return *std::ranges::max_element(values);
}

/// Half a column of sand of width 1 with another height than the shipped scene's 2.
Scene column(double aspect) {
    Scene scene = shipped("granular_column");
    scene.bodies.front().contains = box_region({{0, 0}, {1, aspect}});
    scene.grid.num_cells = {80, static_cast<int>(10 * aspect) + 4};
    scene.end_time = aspect > 2 ? 3 : 2;
    return scene;
}

/// How far a column of sand of half width 1 runs, by that width.
double run_out(const Scene& scene) {
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < scene.end_time) simulation.step();
    return largest(simulation, "x") - 1;
}

// Lube, Huppert, Sparks and Freundt 2005: 1.2 a for aspects below 2.3; at a = 2 their
// experiments lie between 2.40 and 3.60.
TEST(GranularColumn, runs_as_far_as_in_experiments) {
    const double distance = run_out(shipped("granular_column"));
    EXPECT_GT(distance, 2.4);
    EXPECT_LT(distance, 3.6);
}

TEST(GranularColumn, runs_too_far_on_a_slippery_floor_and_not_far_with_cohesion) {
    Scene slippery = shipped("granular_column");
    slippery.walls.bottom = Wall::roller;
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

TEST(GranularColumn, breaks_the_law_with_a_slippery_floor_and_with_cohesion) {
    Scene slippery = column(1);
    slippery.walls.bottom = Wall::roller;
    EXPECT_GT(run_out(slippery), 2 * 1.2);
    Scene sticky = column(1);
    sticky.materials.front().parameters["cohesion"] = 1e3;
    EXPECT_LT(run_out(sticky), 0.5 * 1.2);
}

/// Largest displacement of a cut of 2 m whose weight * height is that many times its strength.
double slip(double number) {
    Scene scene = shipped("vertical_cut");
    scene.materials.front().parameters["strength"] = 1800 * 9.81 * 2 / number;
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < 2.5) simulation.step();
    return largest(simulation, "displacement_x");
}

// A vertical cut stands while weight * height / strength is below 3.77 and fails above 3.83.
TEST(VerticalCut, stands_below_its_critical_height_and_fails_above) {
    // Of the order of what it settles by elastically, weight * height^2 / E = 0.035 m.
    EXPECT_LT(slip(3.7), 0.05);
    EXPECT_GT(slip(4.5), 0.2);
}

// A loss of at most a thousandth in 20 s and never a gain, but for what the square's first
// vibration, until it is held together, takes from the affine fields, whose energy is not counted.
TEST(RotatingSquare, keeps_its_energy) {
    const Scene scene = shipped("rotating_square");
    Simulation simulation(scene, MPI_COMM_WORLD);
    const auto energy = [&] {
        const Totals totals = simulation.totals();
        return totals.kinetic_energy + totals.strain_energy;
    };
    const double initial = energy();
    while (simulation.time() < scene.end_time) {
        for (int step = 0; step < 10; ++step) simulation.step();
        EXPECT_LE(energy(), initial * (simulation.time() < 0.2 ? 1 + 1e-4 : 1));
        EXPECT_GE(energy(), initial * (1 - 1e-3));
    }
}

// What the test must see: FLIP loses most of the energy of a turning square to noise.
TEST(RotatingSquare, loses_energy_with_flip) {
    Scene scene = shipped("rotating_square");
    scene.transfer = Transfer::flip;
    scene.flip_fraction = 0.99;
    Simulation simulation(scene, MPI_COMM_WORLD);
    const double initial = simulation.totals().kinetic_energy;
    while (simulation.time() < 5) simulation.step();
    EXPECT_LT(simulation.totals().kinetic_energy, 0.1 * initial);
}

// The affine field of linear functions must not take up the acceleration of nodes with next to no
// mass: the square flew apart within a second.
TEST(RotatingSquare, holds_together_with_linear_functions) {
    Scene scene = shipped("rotating_square");
    scene.shape_function = ShapeFunction::linear;
    Simulation simulation(scene, MPI_COMM_WORLD);
    const double initial = simulation.totals().kinetic_energy;
    while (simulation.time() < 3) simulation.step();
    EXPECT_NEAR(simulation.totals().kinetic_energy, initial, 0.02 * initial);
}

}  // namespace
}  // namespace mpm::test
