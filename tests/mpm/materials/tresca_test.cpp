#include "materials/tresca.hpp"

#include "materials/undrained.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace mpm::test {
namespace {

void expect_equal(const Principal& values, const Principal& expected) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(values[i], expected[i], 1e-13);
}

// By hand, for a strength of 10, with deviators d and means m.
TEST(Tresca, returns_to_a_side_or_a_corner) {
    // Inside: (19 - 0) / 2 < 10.
    expect_equal(returned_to_tresca(10, Principal{19, 5, 0}), {19, 5, 0});
    // Side: 30 - 0 is 10 too far; half of it from each end, the middle stays.
    expect_equal(returned_to_tresca(10, Principal{30, 16, 0}), {25, 16, 5});
    // Triaxial extension, m = 10: d = (20, -10, -10) ends at the corner (4, -2, -2) * 10 / 3.
    expect_equal(returned_to_tresca(10, Principal{30, 0, 0}),
                 {10 + 40 / 3.0, 10 - 20 / 3.0, 10 - 20 / 3.0});
    // Triaxial compression, and a state near it: the side would put the first below the middle.
    expect_equal(returned_to_tresca(10, Principal{0, 0, -30}),
                 {-10 + 20 / 3.0, -10 + 20 / 3.0, -10 - 40 / 3.0});
    expect_equal(returned_to_tresca(10, Principal{30, 27, 0}),
                 {19 + 20 / 3.0, 19 + 20 / 3.0, 19 - 40 / 3.0});
    // No strength leaves the mean.
    expect_equal(returned_to_tresca(0, Principal{30, 3, 0}), {11, 11, 11});
}

TEST(Tresca, is_von_mises_in_simple_shear_and_stronger_in_triaxial_states) {
    const Stress<3> sheared = returned_to_tresca<3>(5, {0, 0, 0, 0, 20, 0});
    EXPECT_NEAR(sheared.yz, 5, 1e-13);
    EXPECT_NEAR(std::abs(sheared.xx) + std::abs(sheared.yy) + std::abs(sheared.zz), 0, 1e-13);
    EXPECT_NEAR(returned<3>(5, {0, 0, 0, 0, 20, 0}).yz, 5, 1e-13);
    // A column fails at a stress of twice its strength, by von Mises at sqrt(3) times.
    const Stress<3> column = returned_to_tresca<3>(5, {0, -40, 0, 0, 0, 0});
    EXPECT_NEAR(column.xx - column.yy, 10, 1e-13);
    const Stress<3> mises = returned<3>(5, {0, -40, 0, 0, 0, 0});
    EXPECT_NEAR(mises.xx - mises.yy, 5 * std::numbers::sqrt3, 1e-13);
}

/// s t - t s, which is 0 where both have the same principal axes.
double commutator(const Stress<3>& s, const Stress<3>& t) {
    const double a[3][3] = {{s.xx, s.xy, s.zx}, {s.xy, s.yy, s.yz}, {s.zx, s.yz, s.zz}};
    const double b[3][3] = {{t.xx, t.xy, t.zx}, {t.xy, t.yy, t.yz}, {t.zx, t.yz, t.zz}};
    double largest = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            double entry = 0;
            for (int k = 0; k < 3; ++k) entry += a[i][k] * b[k][j] - b[i][k] * a[k][j];
            largest = std::max(largest, std::abs(entry));
        }
    return largest;
}

/// Six numbers from -1 to 1, as a stress.
Stress<3> random_stress(std::mt19937& engine) {
    std::uniform_real_distribution<double> any(-1, 1);
    const double xx = any(engine), yy = any(engine), zz = any(engine);
    const double xy = any(engine), yz = any(engine), zx = any(engine);
    return {xx, yy, zz, xy, yz, zx};
}

TEST(Tresca, keeps_mean_and_axes_of_any_stress_and_leaves_none_beyond) {
    std::mt19937 engine(1);
    const double strength = 0.3;
    int num_returned = 0;
    for (int k = 0; k < 2000; ++k) {
        const Stress<3> trial = random_stress(engine);
        const Stress<3> stress = returned_to_tresca<3>(strength, trial);
        EXPECT_NEAR(mean(stress), mean(trial), 1e-14);
        EXPECT_LT(largest_shear<3>(stress), strength + 1e-14);
        EXPECT_NEAR(commutator(stress, trial), 0, 2e-14);
        if (!(largest_shear<3>(trial) > strength)) continue;
        ++num_returned;
        EXPECT_NEAR(largest_shear<3>(stress), strength, 1e-14);
        const double square = second_invariant(deviator(stress, mean(stress)));
        EXPECT_GT(square, strength * strength - 1e-14);
        EXPECT_LT(square, 4 * strength * strength / 3 + 1e-14);
        const Stress<3> again = returned_to_tresca<3>(strength, stress);
        EXPECT_NEAR(again.xx, stress.xx, 1e-14);
    }
    EXPECT_GT(num_returned, 1000);
}

// No stress within the criterion is nearer to the trial stress than the one returned: the angle
// there is at least a right one.
TEST(Tresca, returns_to_the_nearest_stress) {
    std::mt19937 engine(2);
    const double strength = 0.4;
    const auto product = [](const Stress<3>& a, const Stress<3>& b) {
        return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz +
               2 * (a.xy * b.xy + a.yz * b.yz + a.zx * b.zx);
    };
    const auto difference = [](const Stress<3>& a, const Stress<3>& b) {
        return Stress<3>{a.xx - b.xx, a.yy - b.yy, a.zz - b.zz,
                         a.xy - b.xy, a.yz - b.yz, a.zx - b.zx};
    };
    for (int k = 0; k < 2000; ++k) {
        const Stress<3> trial = random_stress(engine);
        const Stress<3> stress = returned_to_tresca<3>(strength, trial);
        const Stress<3> other = returned_to_tresca<3>(strength, random_stress(engine));
        EXPECT_LT(product(difference(trial, stress), difference(other, stress)), 1e-14);
    }
}

Stress<3> in_space(const Stress<2>& s) {
    return {s.xx, s.yy, s.zz, s.xy, 0, 0};
}

TEST(Tresca, is_the_same_in_plane_strain_and_in_space) {
    std::mt19937 engine(3);
    for (int k = 0; k < 2000; ++k) {
        const Stress<3> any = random_stress(engine);
        const Stress<2> trial{any.xx, any.yy, any.zz, k % 10 == 0 ? 0 : any.xy};
        const Stress<2> plane = returned_to_tresca<2>(0.3, trial);
        const Stress<3> solid = returned_to_tresca<3>(0.3, in_space(trial));
        EXPECT_NEAR(plane.xx, solid.xx, 1e-14);
        EXPECT_NEAR(plane.yy, solid.yy, 1e-14);
        EXPECT_NEAR(plane.zz, solid.zz, 1e-14);
        EXPECT_NEAR(plane.xy, solid.xy, 1e-14);
        EXPECT_NEAR(largest_shear<2>(trial), largest_shear<3>(in_space(trial)), 1e-14);
    }
    // Equal stresses in the plane, more or less along z.
    const Stress<2> corner = returned_to_tresca<2>(3, {0, 0, 30, 0});
    EXPECT_NEAR(corner.xx, 10 - 2, 1e-13);
    EXPECT_NEAR(corner.yy, 10 - 2, 1e-13);
    EXPECT_NEAR(corner.zz, 10 + 4, 1e-13);
}

// Clay that flows without change of volume has the mean of the others along z: then both agree.
TEST(Tresca, is_von_mises_in_plane_strain_without_dilation) {
    std::mt19937 engine(4);
    for (int k = 0; k < 100; ++k) {
        const Stress<3> any = random_stress(engine);
        const Stress<2> trial{any.xx, any.yy, 0.5 * (any.xx + any.yy), any.xy};
        const Stress<2> tresca = returned_to_tresca<2>(0.3, trial);
        const Stress<2> mises = returned<2>(0.3, trial);
        EXPECT_NEAR(tresca.xx, mises.xx, 1e-14);
        EXPECT_NEAR(tresca.yy, mises.yy, 1e-14);
        EXPECT_NEAR(tresca.zz, mises.zz, 1e-14);
        EXPECT_NEAR(tresca.xy, mises.xy, 1e-14);
    }
}

/// The largest difference of axial and mean lateral stress in a cube of clay that is drawn upwards,
/// by its strength.
double pull(const std::string& criterion) {
    const Material clay{"clay",
                        "von_mises",
                        {{"density", 1000.0},
                         {"youngs_modulus", 1e6},
                         {"poissons_ratio", 0.3},
                         {"strength", 1e3},
                         {"criterion", criterion}}};
    const Body cube{.contains = box_region({{0, 0, 0}, {1, 1, 1}}),
                    .points_per_cell = {2, 2, 2},
                    .material = "clay",
                    .velocity = velocity_field({.constant = {0, 0.5, 0}})};
    Scene scene{.name = "cube",
                .dimension = 3,
                .grid = {.lower = {0, 0, 0}, .spacing = 0.5, .num_cells = {4, 4, 4}},
                .materials = {clay},
                .bodies = {cube},
                .walls = {.left = Wall::roller, .bottom = Wall::roller, .back = Wall::roller}};
    Simulation simulation(scene, MPI_COMM_WORLD);
    EXPECT_EQ(std::ranges::count(simulation.kernels(), criterion), 1);
    double largest = 0;
    while (simulation.time() < 0.1) {
        simulation.step();
        const std::vector<double> stress = gathered(simulation, "stress_yy", MPI_COMM_WORLD);
        const std::vector<double> side = gathered(simulation, "stress_xx", MPI_COMM_WORLD);
        const std::vector<double> back = gathered(simulation, "stress_zz", MPI_COMM_WORLD);
        for (std::size_t p = 0; p < stress.size(); ++p)
            largest = std::max(largest, (stress[p] - 0.5 * (side[p] + back[p])) / 1e3);
    }
    return largest;
}

// In triaxial extension Tresca yields at twice its strength and von Mises at sqrt(3) times.
TEST(Tresca, is_a_criterion_of_clay) {
    EXPECT_NEAR(pull("tresca"), 2, 1e-9);
    EXPECT_LT(pull("von_mises"), std::numbers::sqrt3 + 1e-9);
    EXPECT_GT(pull("von_mises"), 1.7);
}

}  // namespace
}  // namespace mpm::test
