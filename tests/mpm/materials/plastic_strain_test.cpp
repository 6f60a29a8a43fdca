#include "materials/material.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mpm::test {
namespace {

constexpr double modulus = 1e6, poissons_ratio = 0.25;
constexpr double shear_modulus = modulus / (2 * (1 + poissons_ratio));

Material soil_of(const std::string& model, Parameters more) {
    more.insert({{"density", 2000.0}, {"youngs_modulus", modulus}});
    more["poissons_ratio"] = poissons_ratio;
    return {"soil", model, more};
}

Material sand(const Parameters& more) {
    Parameters parameters{{"cohesion", 1e3}, {"friction_angle", 20.0}, {"tension_cut_off", 1e3}};
    parameters.insert(more.begin(), more.end());
    return soil_of("drucker_prager", parameters);
}

/// One point of a material, strained step by step.
class Strained {
  public:
    explicit Strained(const Material& material) : model_(build_material<2>(material, particles_)) {
        particles_.append(particles_.initial_row());
        for (auto& row : gradients_)
            for (auto& entry : row) entry.fill(0);
    }

    void shear(double rate, double time_step) {
        gradients_[0][1][0] = rate;
        const PointBlock<2> block{0, 1, 0, 0, time_step, &gradients_};
        for (const auto& kernel : model_.kernels) kernel.kernel(particles_, block);
    }

    double operator[](const std::string& column) const { return particles_[column][0]; }
    bool has(const std::string& column) const { return particles_.has_column(column); }

  private:
    Particles particles_;
    MaterialModel<2> model_;
    VelocityGradients<2> gradients_{};
};

/// Shears a point to and fro, so that it yields both ways and turns by no more than round-off of
/// the second order.
void shear_to_and_fro(Strained& point, double strain) {
    constexpr int steps = 1000;
    for (int step = 0; step < steps; ++step) point.shear(strain / steps, 1);
    for (int step = 0; step < 2 * steps; ++step) point.shear(-strain / steps, 1);
}

// What is not elastic is plastic: k / G each way, and twice that where it turns back. Without
// dilation k = c cos(phi) at no mean stress.
TEST(PlasticStrain, is_the_shear_beyond_the_elastic) {
    constexpr double strain = 0.05;
    const double yield = 1e3 * std::cos(20 * std::numbers::pi / 180) / shear_modulus;
    Strained point(sand({{"plastic_strain", "kept"}}));
    shear_to_and_fro(point, strain);
    const double expected = (strain - yield) + (2 * strain - 2 * yield);
    EXPECT_NEAR(point["plastic_strain"], expected, 1e-3 * expected);
}

TEST(PlasticStrain, of_clay_needs_no_softening) {
    constexpr double strain = 0.05, strength = 2e3;
    Strained point(soil_of("von_mises", {{"strength", strength}, {"plastic_strain", "kept"}}));
    shear_to_and_fro(point, strain);
    const double expected = 3 * (strain - strength / shear_modulus);
    EXPECT_NEAR(point["plastic_strain"], expected, 1e-3 * expected);
}

TEST(PlasticStrain, is_none_below_the_strength) {
    Strained point(sand({{"plastic_strain", "kept"}}));
    point.shear(0.9 * 1e3 * std::cos(20 * std::numbers::pi / 180) / shear_modulus, 1);
    EXPECT_EQ(point["plastic_strain"], 0);
}

// The same stress, to the bit, and a column only where the scene asks for it.
TEST(PlasticStrain, changes_nothing_else) {
    for (const double dilation : {0.0, 10.0}) {
        Strained with(sand({{"dilation_angle", dilation}, {"plastic_strain", "kept"}}));
        Strained without(sand({{"dilation_angle", dilation}}));
        shear_to_and_fro(with, 0.05);
        shear_to_and_fro(without, 0.05);
        EXPECT_FALSE(without.has("plastic_strain"));
        EXPECT_GT(with["plastic_strain"], 0.1);
        for (const char* column : {"stress_xx", "stress_yy", "stress_zz", "stress_xy"})
            EXPECT_EQ(with[column], without[column]) << column << " at " << dilation;
    }
}

}  // namespace
}  // namespace mpm::test
