#include "materials/drucker_prager.hpp"

#include "../../support/common.hpp"

#include <numbers>

namespace mpm {
namespace {

// friction 1/2, cohesion 10, tension 8: at mean -20 the strength is 20, at the limit 6.
constexpr DruckerPrager cone{0.5, 10, 8};

double shear(const Stress<2>& s) {
    return std::sqrt(second_invariant(deviator(s, mean(s))));
}

void expect_stress(const Stress<2>& s, double xx, double yy, double zz, double xy) {
    EXPECT_NEAR(s.xx, xx, 1e-13);
    EXPECT_NEAR(s.yy, yy, 1e-13);
    EXPECT_NEAR(s.zz, zz, 1e-13);
    EXPECT_NEAR(s.xy, xy, 1e-13);
}

TEST(DruckerPrager, leaves_an_elastic_stress_alone) {
    expect_stress(returned<2>(cone, {-10, -20, -30, 5}), -10, -20, -30, 5);
}

TEST(DruckerPrager, leaves_zero_stress_alone) {
    expect_stress(returned<2>(cone, {}), 0, 0, 0, 0);
}

TEST(DruckerPrager, returns_shear_at_constant_mean_stress) {
    // deviator (30, -30, 0, 40): sqrt(J2) = 50, scaled by 20 / 50.
    expect_stress(returned<2>(cone, {10, -50, -20, 40}), -8, -32, -20, 16);
}

TEST(DruckerPrager, cuts_tension_and_keeps_an_admissible_deviator) {
    // mean 15, deviator (3, -3, 0, 0): sqrt(J2) = 3, below the 6 left at the limit.
    expect_stress(returned<2>(cone, {18, 12, 15, 0}), 11, 5, 8, 0);
}

TEST(DruckerPrager, ends_in_the_corner_beyond_both_limits) {
    // mean 15, deviator (0, 0, 0, 12), scaled by 6 / 12.
    expect_stress(returned<2>(cone, {15, 15, 15, 12}), 8, 8, 8, 6);
}

TEST(DruckerPrager, ends_at_the_apex_when_the_limit_is_there) {
    expect_stress(returned<2>({0.5, 10, 20}, {40, 20, 30, 7}), 20, 20, 20, 0);
}

TEST(DruckerPrager, carries_nothing_in_tension_without_cohesion) {
    expect_stress(returned<2>({0.5, 0, 0}, {3, 1, 2, 5}), 0, 0, 0, 0);
}

TEST(DruckerPrager, returns_onto_the_surface_and_only_once) {
    for (int k = 0; k < 400; ++k) {
        const Stress<2> trial{90 * std::sin(1.1 * k), 90 * std::sin(2.3 * k + 1),
                              90 * std::sin(3.7 * k + 2), 90 * std::sin(0.7 * k + 3)};
        const Stress<2> stress = returned<2>(cone, trial);
        EXPECT_LE(mean(stress), cone.tension + 1e-12);
        const double yield = shear(stress) + cone.friction * mean(stress) - cone.cohesion;
        EXPECT_LE(yield, 1e-12);
        if (mean(trial) < cone.tension &&
            shear(trial) + cone.friction * mean(trial) > cone.cohesion) {
            EXPECT_NEAR(yield, 0, 1e-12);
        }
        const Stress<2> again = returned<2>(cone, stress);
        expect_stress(again, stress.xx, stress.yy, stress.zz, stress.xy);
    }
}

TEST(DruckerPrager, matches_mohr_coulomb_in_plane_strain) {
    const DruckerPrager matched = matched_cone(10e3, 20, 1e9);
    EXPECT_NEAR(matched.friction, 0.3420201433256687, 1e-15);
    EXPECT_NEAR(matched.cohesion, 9396.926207859084, 1e-9);
    EXPECT_NEAR(matched.tension, 27474.77419454622, 1e-8);

    // Flow at constant volume makes the stress out of plane the mean of those in it; then the
    // cone touches Mohr-Coulomb: radius = c cos(phi) - centre sin(phi).
    const double centre = -40e3, sine = std::sin(std::numbers::pi / 9);
    const double radius = 10e3 * std::cos(std::numbers::pi / 9) - centre * sine;
    const Stress<2> trial{centre + 2 * radius, centre - 2 * radius, centre, 0};
    const Stress<2> stress = returned<2>(matched, trial);
    EXPECT_NEAR(stress.xx, centre + radius, 1e-7);
    EXPECT_NEAR(stress.yy, centre - radius, 1e-7);
}

TEST(DruckerPrager, keeps_a_lower_tension_limit) {
    EXPECT_EQ(matched_cone(10, 0, 5).tension, 5);
    EXPECT_EQ(matched_cone(10, 0, 5).friction, 0);
}

/// A small anticlockwise rotation.
DisplacementGradient<2> turning(double angle) {
    return {{{0, -angle}, {angle, 0}}};
}

TEST(Elastic, keeps_the_norm_of_the_stress_through_ten_thousand_rotations) {
    // 100 steps a turn. A step of angle w turns by 2 atan(w), the error of the rate's midpoint.
    const double angle = std::numbers::pi / 50;
    Stress<2> stress{30, -10, 5, 7};
    const double radius = std::hypot(20, 7);
    for (int step = 0; step < 1000000; ++step) stress = rotated(stress, turning(-angle));
    EXPECT_NEAR(std::hypot((stress.xx - stress.yy) / 2, stress.xy), radius, 1e-8);
    EXPECT_NEAR(stress.xx + stress.yy, 20, 1e-8);
    EXPECT_EQ(stress.zz, 5);
}

TEST(Elastic, turns_stress_with_the_material) {
    // A quarter turn anticlockwise takes the stress along x to y.
    Stress<2> stress{1, 0, 0, 0};
    const int steps = 1000;
    const double angle = std::numbers::pi / 2 / steps;
    for (int k = 0; k < steps; ++k) stress = rotated(stress, turning(angle));
    EXPECT_NEAR(stress.xx, 0, 1e-5);
    EXPECT_NEAR(stress.yy, 1, 1e-5);

    Stress<2> eighth{1, 0, 0, 0};
    for (int k = 0; k < steps / 2; ++k) eighth = rotated(eighth, turning(angle));
    EXPECT_NEAR(eighth.xy, 0.5, 1e-5);
}

TEST(Elastic, answers_a_strain_as_hooke) {
    // E = 26, nu = 0.3: G = 10, K = 65/3, lambda = 15.
    const Elastic elastic{26, 0.3};
    const Stress<2> stress = strained<2>(Stress<2>{}, {{{0.1, 0.04}, {0.02, 0.2}}},
                                         elastic.bulk_modulus(), elastic.shear_modulus());
    expect_stress(stress, 15 * 0.3 + 2, 15 * 0.3 + 4, 15 * 0.3, 0.6);
    EXPECT_NEAR(elastic.wave_speed(35), 1, 1e-14);
}

}  // namespace
}  // namespace mpm
