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

/// Stiffness, time step and cells along a metre of a flow.
struct Flow {
    double modulus = 1e5, courant_number = 0.5;
    int cells = 8;
};
constexpr std::array flows{Flow{}, Flow{.modulus = 1e6}, Flow{.courant_number = 0.2},
                           Flow{.cells = 16}};

/// What is left of a vortex in mud whose shear modulus is that of a flow, in cells of half the
/// size.
double decayed(const Flow& flow, double yield_stress, double viscosity, double end_time) {
    const Material mud{"mud",
                       "bingham",
                       {{"density", density},
                        {"youngs_modulus", 2.9 * flow.modulus},
                        {"poissons_ratio", 0.45},
                        {"yield_stress", yield_stress},
                        {"viscosity", viscosity}}};
    Scene scene = vortex_scene(mud, 2 * flow.cells, {{"locking_cure", {}}});
    scene.courant_number = flow.courant_number;
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < end_time) simulation.step();
    return strength_of(simulation) / std::exp(-2 * viscosity / density * wave_number * wave_number *
                                              (simulation.time() - end_time));
}

// Taylor and Green: exp(-2 nu k^2 t). That the fluid is elastic first, with a relaxation time of
// a millisecond, changes the rate by 2 nu k^2 * 1 ms = 0.2 %.
TEST(Bingham, vortex_decays_by_its_viscosity) {
    const double rate = 2 * 100 / density * wave_number * wave_number;
    for (const Flow& flow : flows)
        EXPECT_NEAR(decayed(flow, 0, 100, 0.3), std::exp(-rate * 0.3),
                    0.02 * std::exp(-rate * 0.3));
}

TEST(Bingham, does_not_decay_below_its_yield_stress) {
    // Stresses stay below rho v c = 300 Pa: it vibrates, with cos(omega t).
    for (const Flow& flow : flows) {
        const double omega = wave_number * std::sqrt(2 * flow.modulus / density);
        EXPECT_NEAR(decayed(flow, 1e3, 0, 0.4 / omega), std::cos(0.4), 0.02);
    }
}

constexpr double gap = 1, pull = 1;

/// Speed half way between two plates, in the middle of a fluid that its weight pulls along them.
double speed_between_plates(const Flow& flow, double yield_stress, double viscosity,
                            double end_time) {
    const Material mud{"mud",
                       "bingham",
                       {{"density", density},
                        {"youngs_modulus", flow.modulus},
                        {"poissons_ratio", 0.45},
                        {"yield_stress", yield_stress},
                        {"viscosity", viscosity}}};
    Simulation simulation(
        {.name = "plates",
         .grid = {.lower = {0, 0},
                  .spacing = gap / flow.cells,
                  .num_cells = {8 * flow.cells, flow.cells}},
         .materials = {mud},
         .bodies = {{.contains = box_region({{1, 0}, {7, gap}}),
                     .points_per_cell = {2, 2, 1},
                     .material = "mud"}},
         .walls = {.bottom = Wall::fixed, .top = Wall::fixed},
         .effects = {{"gravity", {{"acceleration", std::vector<double>{pull, 0}}}}},
         .shape_function = ShapeFunction::quadratic,
         .courant_number = flow.courant_number},
        MPI_COMM_WORLD);
    while (simulation.time() < end_time) simulation.step();
    const Particles& points = simulation.particles();
    const auto x = points["x"], y = points["y"], speed = points["velocity_x"];
    const auto is_probed = [&](std::size_t p) {
        return std::abs(x[p] - 4) < 0.5 && std::abs(y[p] - 0.5 * gap) < 0.1;
    };
    const double sum = summed(simulation, MPI_COMM_WORLD,
                              [&](std::size_t p) { return is_probed(p) ? speed[p] : 0; });
    return sum /
           summed(simulation, MPI_COMM_WORLD, [&](std::size_t p) { return is_probed(p) ? 1 : 0; });
}

// Started from rest: the series of the diffusion equation.
TEST(Bingham, flows_between_plates_as_a_viscous_fluid) {
    constexpr double viscosity = 200, time = 0.5, pi = std::numbers::pi;
    double expected = pull * density * gap * gap / (8 * viscosity);
    for (int n = 1; n < 20; n += 2)
        expected -= 4 * pull * density * gap * gap / (viscosity * std::pow(n * pi, 3)) *
                    (n % 4 == 1 ? 1 : -1) *
                    std::exp(-viscosity / density * std::pow(n * pi / gap, 2) * time);
    for (const Flow& flow : flows)
        EXPECT_NEAR(speed_between_plates(flow, 0, viscosity, time), expected, 0.03 * expected);
}

// A plug as wide as 2 * yield stress / (density * pull) moves as one.
TEST(Bingham, flows_between_plates_with_a_plug) {
    constexpr double viscosity = 200, yield_stress = 250;
    const double sheared = 0.5 * gap - yield_stress / (density * pull);
    const double expected = density * pull * sheared * sheared / (2 * viscosity);
    for (const Flow& flow : flows)
        EXPECT_NEAR(speed_between_plates(flow, yield_stress, viscosity, 1.5), expected,
                    0.05 * expected);
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
