#include "support.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <tuple>

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

/// Share of the points 6 to 12 m below the surface that have moved by more than a cell and whose
/// mean stress is a tension above 1 % of the overburden.
double share_in_tension(const Simulation& simulation, double cell_size) {
    const auto column = [&](const char* name) {
        return gathered(simulation, name, MPI_COMM_WORLD);
    };
    const std::vector<double> x = column("x"), y = column("y");
    const std::vector<double> way_x = column("displacement_x"), way_y = column("displacement_y");
    const std::vector<double> xx = column("stress_xx"), yy = column("stress_yy"),
                              zz = column("stress_zz");
    std::vector<double> top(static_cast<std::size_t>(110 / cell_size) + 2, -15);
    const auto column_of = [&](std::size_t p) {
        return static_cast<std::size_t>(x[p] / cell_size);
    };
    for (std::size_t p = 0; p < x.size(); ++p)
        top[column_of(p)] = std::max(top[column_of(p)], y[p]);
    int moved = 0, in_tension = 0;
    for (std::size_t p = 0; p < x.size(); ++p) {
        const double depth = top[column_of(p)] - y[p];
        if (depth < 6 || depth > 12 || std::hypot(way_x[p], way_y[p]) < cell_size) continue;
        ++moved;
        in_tension += (xx[p] + yy[p] + zz[p]) / 3 > 0.01 * 2100 * 9.81 * depth;
    }
    EXPECT_GT(moved, 50);
    return static_cast<double>(in_tension) / moved;
}

TEST(Slope, presses_on_what_is_deep_after_it_has_failed) {
    for (const auto& [shape, modulus, courant_number, cells_across] :
         {std::tuple(ShapeFunction::linear, 70e6, 0.5, 44),
          std::tuple(ShapeFunction::linear, 280e6, 0.5, 44),
          std::tuple(ShapeFunction::linear, 70e6, 0.25, 44),
          std::tuple(ShapeFunction::linear, 70e6, 0.5, 66),
          std::tuple(ShapeFunction::quadratic, 70e6, 0.5, 44)}) {
        Scene scene = slope_scene(cells_across);
        scene.shape_function = shape;
        scene.courant_number = courant_number;
        scene.materials.front().parameters["youngs_modulus"] = modulus;
        Simulation simulation(scene, MPI_COMM_WORLD);
        while (simulation.time() < 6) simulation.step();
        EXPECT_LT(share_in_tension(simulation, scene.grid.spacing), 0.01);
    }
    Scene locked = slope_scene(88);
    locked.effects.pop_back();
    Simulation simulation(locked, MPI_COMM_WORLD);
    while (simulation.time() < 6) simulation.step();
    EXPECT_GT(share_in_tension(simulation, locked.grid.spacing), 0.3) << "without the cure";
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
