// Time steps at and beyond their limit, materials ten thousand times as stiff as others, soil that
// holds no tension.
#include "scene/light_nodes.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>

namespace mpm::test {
namespace {

constexpr double pi = std::numbers::pi;

constexpr int num_full_cells = 6, points_per_cell = 4;

/// Bar of wave speed 10 with a trace of the shortest wave that the cells can hold. Its free end
/// lies in a cell that holds only some of its points.
Scene trembling_bar(int points_at_the_end, double courant_number) {
    const double length = num_full_cells + double(points_at_the_end) / points_per_cell;
    return {.name = "trembling bar",
            .grid = {.lower = {0, 0}, .spacing = 1, .num_cells = {num_full_cells + 3, 1}},
            .materials = {elastic_material("rubber", 1, 100, 0)},
            .bodies = {{.contains = box_region({{0, 0}, {length, 1}}),
                        .points_per_cell = {points_per_cell, 2, 1},
                        .material = "rubber",
                        .velocity = velocity_field(
                            {.sine_amplitude = {1e-6, 0}, .sine_wave_number = {0.97 * pi, 0}})}},
            .walls = {.left = Wall::roller, .bottom = Wall::roller, .top = Wall::roller},
            .courant_number = courant_number};
}

/// What a step does to the stresses and then the velocities of the points of that bar, whose wave
/// speed, density and cells are 1 here; nodes by `n`, points by `p`.
Eigen::MatrixXd step_of_a_bar(int points_at_the_end, const StepRule& rule) {
    const int num_points = num_full_cells * points_per_cell + points_at_the_end;
    const double time_step = rule.courant_number;
    Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(num_full_cells + 2, num_points);
    Eigen::MatrixXd slope = weight;
    for (int p = 0; p < num_points; ++p) {
        const int cell = p / points_per_cell;
        const double u = (p % points_per_cell + 0.5) / points_per_cell;
        const double counted = std::clamp(u, rule.least_weight, 1 - rule.least_weight);
        weight.col(p).segment<2>(cell) << 1 - counted, counted;
        slope.col(p).segment<2>(cell) << -1, 1;
    }
    const double point_mass = 1.0 / points_per_cell;
    Eigen::VectorXd mass = point_mass * weight.rowwise().sum();
    if (points_at_the_end == 0) mass(num_full_cells + 1) = 1;
    Eigen::VectorXd inverse_mass = mass.cwiseInverse();
    inverse_mass(0) = 0;  // held
    const Eigen::MatrixXd acceleration = -point_mass * inverse_mass.asDiagonal() * slope;
    const Eigen::MatrixXd velocity = point_mass * inverse_mass.asDiagonal() * weight;
    const auto identity = Eigen::MatrixXd::Identity(num_points, num_points);
    Eigen::MatrixXd step(2 * num_points, 2 * num_points);
    step << identity + time_step * time_step * slope.transpose() * acceleration,
        time_step * slope.transpose() * velocity,  //
        time_step * weight.transpose() * acceleration, identity;
    return step;
}

/// Largest energy of a bar within some steps by that at the start.
double most_energy(const Scene& scene) {
    Simulation simulation(scene, MPI_COMM_WORLD);
    const double start = simulation.totals().kinetic_energy;
    double most = 0;
    while (simulation.step_count() < 600 && most < 100) {
        simulation.step();
        const Totals now = simulation.totals();
        most = std::max(most, (now.kinetic_energy + now.strain_energy) / start);
    }
    return most;
}

// With lumped elements steps would be stable up to a Courant number of 1. Points by themselves are
// up to 2/3 of it; beyond, the rule for light nodes shortens the steps.
TEST(HardLimits, of_the_time_step_are_never_passed) {
    for (const int points_at_the_end : {0, 1, 2, 3})
        for (const double courant_number : {0.2, 0.4, 0.5, 0.6, 0.7, 1.0}) {
            SCOPED_TRACE(courant_number);
            const Scene scene = trembling_bar(points_at_the_end, courant_number);
            const StepRule rule = rule_for(scene);
            EXPECT_NEAR(rule.courant_number, std::min(courant_number, 2.0 / 3), 1e-9);
            const Eigen::MatrixXd step = step_of_a_bar(points_at_the_end, rule);
            EXPECT_LT(step.eigenvalues().cwiseAbs().maxCoeff(), 1 + 1e-7);
            EXPECT_LT(most_energy(scene), 4);
        }
}

constexpr double soft_modulus = 100, stiffness_ratio = 1e4, soft_length = 5;

/// A soft bar that vibrates in mode 1, held by a stiff one of 2 m.
Scene bar_on_a_stiff_one() {
    const double wave_number = pi / (2 * soft_length);
    const Body soft{.contains = box_region({{2, 0}, {2 + soft_length, 0.5}}),
                    .material = "soft",
                    .velocity = velocity_field({.sine_amplitude = {0.05, 0},
                                                .sine_wave_number = {wave_number, 0},
                                                .sine_phase = -2 * wave_number})};
    return {.name = "bar on a stiff one",
            .grid = {.lower = {0, 0}, .spacing = 0.5, .num_cells = {18, 1}},
            .materials = {elastic_material("stiff", 1, stiffness_ratio * soft_modulus, 0),
                          elastic_material("soft", 1, soft_modulus, 0)},
            .bodies = {{.contains = box_region({{0, 0}, {2, 0.5}}), .material = "stiff"}, soft},
            .walls = {.left = Wall::roller, .bottom = Wall::roller, .top = Wall::roller},
            .courant_number = 0.4};
}

double largest_displacement(const Simulation& simulation, double number_of_material) {
    double largest = 0;
    const auto material = simulation.particles()["material"];
    const auto displacement = displacements_along(simulation, 0);
    for (std::size_t p = 0; p < material.size(); ++p)
        if (material[p] == number_of_material)
            largest = std::max(largest, std::abs(displacement[p]));
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return largest;
}

TEST(HardLimits, of_stiffness_leave_the_soft_part_its_period) {
    Simulation simulation(bar_on_a_stiff_one(), MPI_COMM_WORLD);
    const double start = total_energy(simulation);
    double before = simulation.totals().momentum[0];
    double turned = 0;
    while (turned == 0 && simulation.time() < 1) {
        const double from = simulation.time();
        simulation.step();
        const double now = simulation.totals().momentum[0];
        if (now <= 0) turned = from + (simulation.time() - from) * before / (before - now);
        before = now;
        EXPECT_NEAR(total_energy(simulation), start, 0.01 * start);
    }
    // A quarter of the period 4 L / c of a bar held at one end.
    EXPECT_NEAR(turned, soft_length / 10, 0.005);
    // By then its end has moved by amplitude over frequency. The stiff bar, 2 m long, has the
    // strain of the soft one's root over the ratio; applied at once, twice that.
    const double soft = 0.05 * 2 * soft_length / (10 * pi);
    EXPECT_NEAR(largest_displacement(simulation, 1), soft, 0.02 * soft);
    const double strain = soft * pi / (2 * soft_length);
    EXPECT_LT(largest_displacement(simulation, 0), 2 * 2 * strain / stiffness_ratio);
}

/// Dry sand that is torn apart over a floor, then falls back.
Scene torn_sand() {
    const Body heap{.contains = box_region({{3, 0}, {5, 1.5}}),
                    .material = "sand",
                    .velocity = velocity_field({.constant = {0, 1.5},
                                                .sine_amplitude = {1, 1},
                                                .sine_wave_number = {pi / 2, pi / 2}})};
    return {.name = "torn sand",
            .grid = {.lower = {0, 0}, .spacing = 0.25, .num_cells = {32, 16}},
            .materials = {soil_material("sand", 1600, 0, 35)},
            .bodies = {heap},
            .walls = {.left = Wall::roller, .right = Wall::roller, .bottom = Wall::roller},
            .effects = {gravity_effect(9.81)},
            .courant_number = 0.25};
}

TEST(HardLimits, of_strength_at_the_apex_without_cohesion) {
    Simulation simulation(torn_sand(), MPI_COMM_WORLD);
    const double start = total_energy(simulation);
    double lost_contact = 0;
    while (simulation.time() < 1) {
        simulation.step();
        const auto xx = simulation.particles()["stress_xx"];
        const auto yy = simulation.particles()["stress_yy"];
        const auto zz = simulation.particles()["stress_zz"];
        for (std::size_t p = 0; p < xx.size(); ++p) {
            ASSERT_TRUE(std::isfinite(xx[p] + yy[p] + zz[p]));
            ASSERT_LE(xx[p] + yy[p] + zz[p], 0);
            lost_contact += xx[p] == 0 && yy[p] == 0 && zz[p] == 0 ? 1 : 0;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &lost_contact, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_GT(lost_contact, 1000);
    EXPECT_LE(total_energy(simulation), 1.01 * start);
}

}  // namespace
}  // namespace mpm::test
