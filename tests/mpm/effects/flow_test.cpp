#include "support.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mpm::test {
namespace {

constexpr double wave_number = std::numbers::pi, density = 1000, amplitude = 0.01;

/// The vortex (sin kx cos ky, -cos kx sin ky): without divergence, shear stress and flow through
/// the sides of the unit square.
Vector vortex(const Vector& at) {
    const double x = wave_number * at[0], y = wave_number * at[1];
    return {std::sin(x) * std::cos(y), -std::cos(x) * std::sin(y), 0};
}

Scene vortex_scene(const Material& material, int cells, std::vector<Effect> effects) {
    const auto velocity = [](const Vector& at) {
        const Vector mode = vortex(at);
        return Vector{amplitude * mode[0], amplitude * mode[1], 0};
    };
    return {.name = "vortex",
            .grid = {.lower = {0, 0}, .spacing = 1.0 / cells, .num_cells = {cells, cells}},
            .materials = {material},
            .bodies = {{.contains = box_region({{0, 0}, {1, 1}}),
                        .points_per_cell = {2, 2, 1},
                        .material = material.name,
                        .velocity = velocity}},
            .walls = {.left = Wall::roller,
                      .right = Wall::roller,
                      .bottom = Wall::roller,
                      .top = Wall::roller},
            .effects = std::move(effects)};
}

/// What is left of the vortex, by what it was at the start.
double strength_of(const Simulation& simulation) {
    const Particles& points = simulation.particles();
    const auto x = points["x"], y = points["y"], u = points["velocity_x"], v = points["velocity_y"];
    const auto sum = [&](auto value) { return summed(simulation, MPI_COMM_WORLD, value); };
    const double product = sum([&](std::size_t p) {
        const Vector mode = vortex({x[p], y[p], 0});
        return u[p] * mode[0] + v[p] * mode[1];
    });
    const double square = sum([&](std::size_t p) {
        const Vector mode = vortex({x[p], y[p], 0});
        return mode[0] * mode[0] + mode[1] * mode[1];
    });
    return product / (amplitude * square);
}

/// A quarter of the period of the vortex in a nearly incompressible solid, s.
double quarter_period(int cells, std::vector<Effect> effects) {
    const Material jelly = elastic_material("jelly", density, 2 * 1.499 * 1e5, 0.499);
    Simulation simulation(vortex_scene(jelly, cells, std::move(effects)), MPI_COMM_WORLD);
    double before = 1, now = 1, start = 0;
    while (now > 0) {
        start = simulation.time();
        before = now;
        simulation.step();
        now = strength_of(simulation);
    }
    return start + (simulation.time() - start) * before / (before - now);
}

// The vortex strains by pure shear: omega^2 = 2 k^2 G / rho, G = 1e5 Pa. Without the cure, the
// points of a cell resist the change of volume that bilinear velocities have off its centre.
TEST(LockingCure, gives_a_nearly_incompressible_solid_its_period) {
    const double expected = 0.5 * std::numbers::pi / (wave_number * std::sqrt(2 * 1e5 / density));
    const double coarse = quarter_period(8, {{"locking_cure", {}}}) / expected - 1;
    const double fine = quarter_period(16, {{"locking_cure", {}}}) / expected - 1;
    EXPECT_NEAR(fine, 0, 0.02);
    EXPECT_NEAR(coarse / fine, 4, 0.5) << "second order";
    EXPECT_LT(quarter_period(8, {}), 0.6 * expected);
}

// Points far off the centres of their cells: without the forces that belong to the shared strain,
// energy would come from nowhere.
TEST(LockingCure, gains_no_energy) {
    Scene scene = vortex_scene(elastic_material("jelly", density, 2 * 1.49 * 1e4, 0.49), 8,
                               {{"locking_cure", {}}});
    scene.bodies.front().velocity = [](const Vector& at) {
        const Vector mode = vortex(at);
        return Vector{2 * mode[0], 2 * mode[1], 0};
    };
    scene.courant_number = 0.1;
    Simulation simulation(scene, MPI_COMM_WORLD);
    const double initial = simulation.totals().kinetic_energy;
    while (simulation.time() < 0.5) simulation.step();
    const Totals end = simulation.totals();
    EXPECT_NEAR(end.kinetic_energy + end.strain_energy, initial, 0.05 * initial);
}

}  // namespace
}  // namespace mpm::test
