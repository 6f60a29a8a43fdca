#include "support.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mpm::test {
namespace {

/// Largest displacement after some seconds, m.
double slip_of(const Scene& scene, double seconds) {
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < seconds) simulation.step();
    const std::vector<double> x = gathered(simulation, "displacement_x", MPI_COMM_WORLD);
    const std::vector<double> y = gathered(simulation, "displacement_y", MPI_COMM_WORLD);
    double largest = 0;
    for (std::size_t p = 0; p < x.size(); ++p) largest = std::max(largest, std::hypot(x[p], y[p]));
    return largest;
}

TEST(Slope, has_the_number_of_points_of_the_paper_within_a_thousandth) {
    const Simulation simulation(slope_scene(), MPI_COMM_WORLD);
    EXPECT_EQ(simulation.num_points(), 54464);
    EXPECT_NEAR(static_cast<double>(simulation.num_points()), 54440, 54);
}

TEST(Slope, fails_and_runs_out) {
    EXPECT_GT(slip_of(slope_scene(44), 5), 4);
}

TEST(Slope, stays_with_ten_times_the_cohesion) {
    Scene strong = slope_scene(44);
    Parameters& soil = strong.materials.front().parameters;
    soil["cohesion"] = 100e3;
    soil["tension_cut_off"] = 274.8e3;
    EXPECT_LT(slip_of(strong, 4), 0.5);
}

TEST(Slope, builds_only_what_the_scene_names) {
    Scene scene = coarse_slope();
    EXPECT_EQ(Simulation(scene, MPI_COMM_WORLD).kernels(),
              (std::vector<std::string>{"p2g", "ghost_nodes", "gravity", "walls", "move_nodes",
                                        "g2p", "elastic", "drucker_prager", "migrate"}));
    scene.effects.clear();
    scene.materials.front() = elastic_material("soil", 2100, 70e6, 0.3);
    EXPECT_EQ(Simulation(scene, MPI_COMM_WORLD).kernels(),
              (std::vector<std::string>{"p2g", "ghost_nodes", "walls", "move_nodes", "g2p",
                                        "elastic", "migrate"}));
}

TEST(Scene, is_refused_with_the_reason) {
    Scene scene = coarse_slope();
    scene.materials.front().parameters["poissons_ratio"] = 0.5;
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD), std::invalid_argument);
    scene = coarse_slope();
    scene.bodies.front().contains = [](const Vector&) { return false; };
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD), std::invalid_argument);
    scene.bodies.clear();
    EXPECT_THROW(Simulation(scene, MPI_COMM_WORLD), std::invalid_argument);
}

}  // namespace
}  // namespace mpm::test
