#include "materials/plastic_work.hpp"
#include "particles/stress.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mpm::test {
namespace {

constexpr double modulus = 1e6, poissons_ratio = 0.25;
constexpr double volume = 3;
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
        add_plastic_work<2>(material, particles_, particles_.add_column("plastic_work"), model_);
        particles_.append(particles_.initial_row());
        particles_.data(particles_.find_column("volume"))[0] = volume;
        for (auto& row : gradients_)
            for (auto& entry : row) entry.fill(0);
    }

    void shear(double rate, double time_step) {
        gradients_[0][1][0] = rate;
        const PointBlock<2> block{0, 1, 0, 0, time_step, &gradients_};
        const double half_strain = 0.5 * rate * time_step;
        work_ += volume * half_strain * particles_["stress_xy"][0];
        for (const auto& kernel : model_.kernels) kernel.kernel(particles_, block);
        work_ += volume * half_strain * particles_["stress_xy"][0];
    }

    double work() const { return work_; }  ///< of the stress on all strain
    double stored() const { return model_.strain_energy(particles_, 0); }
    double operator[](const std::string& column) const { return particles_[column][0]; }
    bool has(const std::string& column) const { return particles_.has_column(column); }

  private:
    Particles particles_;
    MaterialModel<2> model_;
    double work_ = 0;
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

TEST(PlasticWork, is_strength_times_plastic_strain) {
    constexpr double strain = 0.05, strength = 2e3;
    Strained point(soil_of("von_mises", {{"strength", strength}}));
    shear_to_and_fro(point, strain);
    const double expected = volume * strength * 3 * (strain - strength / shear_modulus);
    EXPECT_NEAR(point["plastic_work"], expected, 1e-3 * expected);
}

// A fluid without strength that is sheared at one rate: viscosity * rate^2, once its elastic part
// has caught up.
TEST(PlasticWork, is_what_viscosity_takes) {
    constexpr double viscosity = 1e3, rate = 0.5, time_step = 1e-3;
    Strained point(soil_of("bingham", {{"viscosity", viscosity}}));
    for (int step = 0; step < 100; ++step) point.shear(rate, time_step);
    const double before = point["plastic_work"];
    for (int step = 0; step < 100; ++step) point.shear(rate, time_step);
    const double expected = volume * viscosity * rate * rate * 100 * time_step;
    EXPECT_NEAR(point["plastic_work"] - before, expected, 1e-3 * expected);
}

// However few the steps, what stress does is stored or plastic. Dilation stores more and more as
// the sand may not expand.
TEST(PlasticWork, and_stored_energy_are_the_work_of_stress) {
    const std::vector<Material> soils{
        sand({}), sand({{"dilation_angle", 10.0}}), sand({{"plastic_strain", "kept"}}),
        soil_of("von_mises",
                {{"strength", 2e3}, {"residual_ratio", 0.3}, {"softening_strain", 0.02}})};
    for (const Material& soil : soils) {
        Strained point(soil);
        for (int step = 0; step < 20; ++step) point.shear(step < 10 ? 1e-3 : -1e-3, 1);
        EXPECT_GT(point["plastic_work"], 0.1 * point.stored());
        EXPECT_NEAR(point["plastic_work"] + point.stored(), point.work(), 1e-3 * point.work());
    }
}

TEST(PlasticWork, is_none_in_what_is_elastic) {
    Strained point(soil_of("elastic", {}));
    shear_to_and_fro(point, 0.05);
    EXPECT_EQ(point["plastic_work"], 0);
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
