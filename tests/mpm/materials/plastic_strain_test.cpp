#include "materials/material.hpp"
#include "particles/stress.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

namespace mpm::test {
namespace {

constexpr double modulus = 1e6, poissons_ratio = 0.25, strength = 2e3;
constexpr double shear_modulus = modulus / (2 * (1 + poissons_ratio));

Material clay(Parameters more) {
    more.insert({{"density", 2000.0}, {"youngs_modulus", modulus}, {"strength", strength}});
    more["poissons_ratio"] = poissons_ratio;
    return {"clay", "von_mises", more};
}

/// Soil without friction: as strong as the clay.
Material soil(Parameters more) {
    more.insert({{"cohesion", strength}, {"friction_angle", 0.0}});
    Material material = clay(more);
    material.model = "drucker_prager";
    material.parameters.erase("strength");
    return material;
}

/// One point of a material, strained step by step.
class Strained {
  public:
    explicit Strained(const Material& material) : model_(build_material<2>(material, particles_)) {
        particles_.append(std::vector<double>(particles_.column_names().size()));
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

// What is not elastic is plastic: strength / G less each way, and twice that on the way back.
TEST(PlasticStrain, is_what_is_not_elastic) {
    constexpr double strain = 0.05;
    const double expected = 3 * (strain - strength / shear_modulus);
    for (const auto make : {clay, soil}) {
        Strained point(make({{"plastic_strain", "kept"}}));
        shear_to_and_fro(point, strain);
        EXPECT_NEAR(point["plastic_strain"], expected, 1e-3 * expected);
    }
}

TEST(PlasticStrain, is_none_below_the_strength) {
    for (const auto make : {clay, soil}) {
        Strained point(make({{"plastic_strain", "kept"}}));
        point.shear(0.9 * strength / shear_modulus, 1);
        EXPECT_EQ(point["plastic_strain"], 0);
    }
}

// The same stress, to the bit, and a column only if the scene asks for it.
TEST(PlasticStrain, changes_nothing_else) {
    for (const auto make : {clay, soil}) {
        Strained with(make({{"plastic_strain", "kept"}})), without(make({}));
        shear_to_and_fro(with, 0.05);
        shear_to_and_fro(without, 0.05);
        EXPECT_FALSE(without.has("plastic_strain"));
        EXPECT_GT(with["plastic_strain"], 0.1);
        for (const char* column : {"stress_xx", "stress_yy", "stress_zz", "stress_xy"})
            EXPECT_EQ(with[column], without[column]) << column;
    }
}

}  // namespace
}  // namespace mpm::test
