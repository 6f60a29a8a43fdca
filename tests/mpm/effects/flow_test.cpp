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
            .effects = std::move(effects),
            .flip_fraction = 1};
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

double decayed(double yield_stress, double viscosity, double end_time) {
    const Material mud{"mud",
                       "herschel_bulkley",
                       {{"density", density},
                        {"youngs_modulus", 2.9e5},
                        {"poissons_ratio", 0.45},
                        {"yield_stress", yield_stress},
                        {"consistency", viscosity}}};
    Simulation simulation(vortex_scene(mud, 16, {{"locking_cure", {}}}), MPI_COMM_WORLD);
    while (simulation.time() < end_time) simulation.step();
    return strength_of(simulation) / std::exp(-2 * viscosity / density * wave_number * wave_number *
                                              (simulation.time() - end_time));
}

// Taylor and Green: exp(-2 nu k^2 t). That the fluid is elastic first, with a relaxation time of
// a millisecond, changes the rate by 2 nu k^2 * 1 ms = 0.2 %.
TEST(HerschelBulkley, vortex_decays_by_its_viscosity) {
    const double rate = 2 * 100 / density * wave_number * wave_number;
    EXPECT_NEAR(decayed(0, 100, 0.3), std::exp(-rate * 0.3), 0.02 * std::exp(-rate * 0.3));
}

TEST(HerschelBulkley, does_not_decay_below_its_yield_stress) {
    // Stresses stay below rho v c = 100 Pa: it vibrates, with cos(omega t).
    const double omega = wave_number * std::sqrt(2 * 1e5 / density);
    EXPECT_NEAR(decayed(1e3, 0, 0.01), std::cos(omega * 0.01), 0.02);
}

// Points far off the centres of their cells: without the forces that belong to the shared strain,
// energy would come from nowhere.
TEST(LockingCure, closes_the_account_of_energy) {
    Scene scene = vortex_scene(elastic_material("jelly", density, 2 * 1.49 * 1e4, 0.49), 8,
                               {{"locking_cure", {}}, {"energy_audit", {}}});
    scene.bodies.front().velocity = [](const Vector& at) {
        const Vector mode = vortex(at);
        return Vector{2 * mode[0], 2 * mode[1], 0};
    };
    scene.courant_number = 0.1;
    Simulation simulation(scene, MPI_COMM_WORLD);
    const double initial = simulation.totals().kinetic_energy;
    while (simulation.time() < 0.5) simulation.step();
    const Totals end = simulation.totals();
    EXPECT_NEAR(end.kinetic_energy + end.strain_energy + lost_energy(simulation), initial,
                0.01 * initial);
}

/// A block in free fall over an open grid.
Simulation falling(std::vector<Effect> effects) {
    return {{.name = "fall",
             .grid = {.lower = {0, 0}, .spacing = 1, .num_cells = {4, 12}},
             .materials = {elastic_material("rubber", density, 1e6, 0.3)},
             .bodies = {{.contains = box_region({{1, 9}, {3, 11}}),
                         .points_per_cell = {2, 2, 1},
                         .material = "rubber"}},
             .effects = std::move(effects)},
            MPI_COMM_WORLD};
}

TEST(LocalDamping, takes_its_share_of_the_force_against_the_motion_until_its_time) {
    const double share = 0.8, until = 0.1;
    Simulation simulation =
        falling({gravity_effect(10), {"local_damping", {{"fraction", share}, {"until", until}}}});
    // At rest there is no motion to act against, so the first step is in full.
    double expected = 0;
    while (simulation.time() < 2 * until) {
        const bool is_free = expected == 0 || simulation.time() >= until;
        expected += 10 * simulation.time_step() * (is_free ? 1 : 1 - share);
        simulation.step();
        EXPECT_NEAR(simulation.max_speed(), expected, 1e-12);
    }
}

}  // namespace
}  // namespace mpm::test
