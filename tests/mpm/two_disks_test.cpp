#include "support.hpp"

#include <gtest/gtest.h>
#include <scene_file/scene_file_mpi.hpp>

namespace mpm::test {
namespace {

Scene disks() {
    return read_scene(RRCB_SCENES "/two_disks.yaml", MPI_COMM_WORLD).scene;
}

// Sulsky, Chen and Schreyer 1994: two disks of 2.51327 J meet at 1.586 s.
TEST(TwoDisks, meet_when_they_touch_and_keep_momentum_and_energy) {
    Simulation simulation(disks(), MPI_COMM_WORLD);
    const double initial = simulation.totals().kinetic_energy;
    EXPECT_NEAR(initial, 2.51327, 0.01 * 2.51327);
    double least = initial;
    while (simulation.time() < 2.5) {
        simulation.step();
        if (simulation.step_count() % 20 != 0) continue;
        const Totals now = simulation.totals();
        // Grid contact is felt where the functions of both reach one node, 1.125 cells from each:
        // at most 2 * 1.125 * 0.0707 / 0.283 s before the disks touch.
        if (simulation.time() < 1.586 - 0.57) {
            EXPECT_NEAR(now.kinetic_energy, initial, 1e-9);
        }
        least = std::min(least, now.kinetic_energy);
        EXPECT_NEAR(now.momentum[0], 0, 1e-10);
        EXPECT_NEAR(now.momentum[1], 0, 1e-10);
        EXPECT_NEAR(total_energy(simulation), initial, 1e-3 * initial);
    }
    EXPECT_LT(least, 0.3 * initial);
    EXPECT_GT(simulation.totals().kinetic_energy, 0.85 * initial);
}

/// Kinetic and strain energy that are gone after the impact, by what there was.
double loss(double courant_number) {
    Scene scene = disks();
    scene.courant_number = courant_number;
    for (Body& body : scene.bodies) body.points_per_cell = {2, 2, 1};
    Simulation simulation(scene, MPI_COMM_WORLD);
    const double initial = simulation.totals().kinetic_energy;
    while (simulation.time() < scene.end_time) simulation.step();
    const Totals end = simulation.totals();
    return 1 - (end.kinetic_energy + end.strain_energy) / initial;
}

// What FLIP does not hand back to the points is of second order in a step's change of velocity: the
// loss is of first order in the time step, and without one nothing is lost.
TEST(TwoDisks, lose_energy_to_the_time_step_alone) {
    const double coarse = loss(0.01), fine = loss(0.005);
    EXPECT_GT(fine, 0);
    EXPECT_LT(fine, 0.005);
    EXPECT_NEAR(2 * fine - coarse, 0, 1e-3);
}

}  // namespace
}  // namespace mpm::test
