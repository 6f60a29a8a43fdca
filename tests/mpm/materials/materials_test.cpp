#include "materials/drucker_prager.hpp"
#include "materials/undrained.hpp"
#include "transfer/shape_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mpm {
namespace {

TEST(Undrained, returns_to_the_strength_at_the_same_mean_stress) {
    // Deviator (30, -30, 0, 40): sqrt(J2) = 50, brought down to 10.
    const Stress<2> stress = returned<2>(10.0, {40, -20, 10, 40});
    EXPECT_NEAR(stress.xx, 16, 1e-13);
    EXPECT_NEAR(stress.yy, 4, 1e-13);
    EXPECT_NEAR(stress.zz, 10, 1e-13);
    EXPECT_NEAR(stress.xy, 8, 1e-13);
    // In three dimensions J2 = 2^2 + 3^2 + 6^2 = 49, brought down from 7 to 3.5.
    const Stress<3> solid = returned<3>(3.5, {1, 1, 1, 2, 3, 6});
    EXPECT_NEAR(solid.xx, 1, 1e-14);
    EXPECT_NEAR(solid.xy, 1, 1e-14);
    EXPECT_NEAR(solid.yz, 1.5, 1e-14);
    EXPECT_NEAR(solid.zx, 3, 1e-14);
    EXPECT_EQ(returned<2>(0.0, Stress<2>{}).xx, 0);
}

TEST(Undrained, is_stronger_at_depth_and_weaker_after_strain) {
    const UndrainedStrength clay{.at_surface = 2e3,
                                 .gradient = 1.5e3,
                                 .surface = 10,
                                 .residual_ratio = 0.2,
                                 .softening_strain = 0.5};
    EXPECT_EQ(clay.intact(6), 8e3);
    EXPECT_EQ(clay.intact(12), 2e3);
    EXPECT_EQ(clay.softened(0), 1);
    EXPECT_NEAR(clay.softened(0.5), 0.2 + 0.8 * 0.049787068367863944, 1e-15);
    EXPECT_NEAR(clay.softened(50), 0.2, 1e-15);
}

// E = 26, nu = 0.3: G = 10, lambda = 15.
constexpr Elastic rubber{26, 0.3};

TEST(Elastic, answers_a_strain_in_three_dimensions_as_hooke) {
    const DisplacementGradient<3> gradient{{{0.1, 0.04, 0}, {0.02, 0.2, 0.5}, {0.3, 0.1, -0.1}}};
    const Stress<3> stress =
        strained<3>(Stress<3>{}, gradient, rubber.bulk_modulus(), rubber.shear_modulus());
    EXPECT_NEAR(stress.xx, 15 * 0.2 + 2, 1e-13);
    EXPECT_NEAR(stress.yy, 15 * 0.2 + 4, 1e-13);
    EXPECT_NEAR(stress.zz, 15 * 0.2 - 2, 1e-13);
    EXPECT_NEAR(stress.xy, 0.6, 1e-13);
    EXPECT_NEAR(stress.yz, 6, 1e-13);
    EXPECT_NEAR(stress.zx, 3, 1e-13);
}

TEST(Elastic, turns_stress_about_any_axis) {
    // A third of a turn about (1, 1, 1) takes x to y, y to z and z to x.
    const int steps = 2000;
    const double angle = 2 * std::numbers::pi / 3 / steps, w = angle / std::sqrt(3.0);
    Stress<3> stress{1, 2, 3, 4, 5, 6};
    for (int k = 0; k < steps; ++k)
        stress = rotated(stress, DisplacementGradient<3>{{{0, -w, w}, {w, 0, -w}, {-w, w, 0}}});
    EXPECT_NEAR(stress.xx, 3, 1e-5);
    EXPECT_NEAR(stress.yy, 1, 1e-5);
    EXPECT_NEAR(stress.zz, 2, 1e-5);
    EXPECT_NEAR(stress.xy, 6, 1e-5);
    EXPECT_NEAR(stress.yz, 4, 1e-5);
    EXPECT_NEAR(stress.zx, 5, 1e-5);
}

// A step of the angle w turns by atan(w) in the plane and by 2 atan(w / 2) in space: w^3 / 4 apart.
TEST(Elastic, turns_the_same_in_two_and_three_dimensions) {
    const double w = 1e-3;
    const Stress<2> plane = rotated(Stress<2>{3, -1, 5, 2}, {{{0, -w}, {w, 0}}});
    const Stress<3> solid =
        rotated(Stress<3>{3, -1, 5, 2, 0, 0}, DisplacementGradient<3>{{{0, -w, 0}, {w, 0, 0}, {}}});
    EXPECT_NEAR(solid.xx, plane.xx, 2e-9);
    EXPECT_NEAR(solid.yy, plane.yy, 2e-9);
    EXPECT_NEAR(solid.xy, plane.xy, 2e-9);
    EXPECT_NEAR(solid.zz, 5, 1e-14);
}

template <class Shape>
void expect_consistent(const Shape& shape, double from, double to) {
    for (double u = from; u <= to; u += (to - from) / 64) {
        const auto weights = shape.at(u);
        const auto near = shape.at(u + 1e-6), far = shape.at(u - 1e-6);
        double sum = 0, slope = 0, centre = 0;
        for (std::size_t i = 0; i < Shape::num_nodes; ++i) {
            EXPECT_GE(weights.value[i], -1e-15);
            sum += weights.value[i];
            slope += weights.slope[i];
            centre += static_cast<double>(i) * weights.value[i];
            EXPECT_NEAR((near.value[i] - far.value[i]) / 2e-6, weights.slope[i], 2e-6);
        }
        EXPECT_NEAR(sum, 1, 1e-14);
        EXPECT_NEAR(slope, 0, 1e-14);
        EXPECT_NEAR(centre, u, 1e-14) << "a linear field must be kept";
    }
}

TEST(ShapeFunctions, keep_linear_fields_and_have_the_slopes_they_say) {
    expect_consistent(LinearShape(), 1e-5, 1 - 1e-5);  // 1e-12 off on the faces
    expect_consistent(QuadraticShape(), 0.5, 1.5);
}

}  // namespace
}  // namespace mpm
