#include "variations.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mpm::test {
namespace {

constexpr double g = 9.81, density = 2000, water_density = 1000;
constexpr double slope_angle = 30 * std::numbers::pi / 180, friction_angle = 10;
/// The layer across the slope, m, in cells of a metre unless varied; its ends are free and stand by
/// cohesion.
constexpr double thickness = 8, length = 64, first_x = 16;

/// What cohesion gives the factor of safety (c + g' H cos^2 b tan phi) / (g' H sin b cos b), with
/// H = d / cos b upright and d the depth of the middle of the lowest cell: a cell of linear shape
/// functions has one shear strain, and half of its weight hangs on the nodes that are fixed.
double cohesion_for(double factor_of_safety, double unit_weight, double cell_size = 1) {
    const double depth = thickness - 0.5 * cell_size;
    const double tan_friction = std::tan(friction_angle * std::numbers::pi / 180);
    return unit_weight * depth *
           (factor_of_safety * std::sin(slope_angle) - std::cos(slope_angle) * tan_friction);
}

/// A long layer on rough rock, with gravity inclined in place of the rock, and damped.
Scene layer(double cohesion, std::vector<Effect> effects) {
    const std::vector<double> gravity{g * std::sin(slope_angle), -g * std::cos(slope_angle)};
    effects.push_back({"gravity", {{"acceleration", gravity}, {"ramp", 1.0}}});
    effects.push_back({"damping", {{"rate", 5.0}, {"until", 10.0}}});
    return {.name = "layer",
            .grid = {.lower = {0, 0}, .spacing = 1, .num_cells = {120, 12}},
            .materials = {{"soil",
                           "drucker_prager",
                           {{"density", density},
                            {"youngs_modulus", 1e8},
                            {"poissons_ratio", 0.3},
                            {"cohesion", cohesion},
                            {"friction_angle", friction_angle},
                            {"tension_cut_off", 1e6}}}},
            .bodies = {{.contains = box_region({{first_x, 0}, {first_x + length, thickness}}),
                        .points_per_cell = {2, 2, 1},
                        .material = "soil"}},
            .walls = {.bottom = Wall::fixed},
            .effects = std::move(effects)};
}

/// How fast the surface of the middle third creeps after 4 s, m/s.
double creep(double cohesion, std::vector<Effect> effects = {}, const Variation& varied = {}) {
    Scene scene = layer(cohesion, std::move(effects));
    vary(scene, varied);
    Simulation simulation(scene, MPI_COMM_WORLD);
    while (simulation.time() < 4) simulation.step();
    const std::vector<double> x = gathered(simulation, "x", MPI_COMM_WORLD);
    const std::vector<double> velocity = gathered(simulation, "velocity_x", MPI_COMM_WORLD);
    double fastest = 0;
    for (std::size_t p = 0; p < x.size(); ++p)
        if (std::abs(x[p] - first_x - length / 2) < length / 6)
            fastest = std::max(fastest, velocity[p]);
    return fastest;
}

// Friction of 10 degrees: without dilation, steady shear takes cos(phi) = 0.985 of the strength.
TEST(InfiniteSlope, stands_above_a_factor_of_safety_of_one_and_fails_below) {
    for (const Variation& varied : variations) {
        SCOPED_TRACE(testing::PrintToString(varied));
        const auto creep_at = [&](double factor_of_safety) {
            return creep(cohesion_for(factor_of_safety, density * g, varied.cell_size), {}, varied);
        };
        EXPECT_LT(creep_at(1.04), 3e-3) << "a tenth of what fails";
        EXPECT_GT(creep_at(0.96), 0.03);
    }
}

TEST(InfiniteSlope, has_its_buoyant_weight_under_water) {
    const double unit_weight = (density - water_density) * g;
    const std::vector<Effect> water{{"buoyancy", {{"water_density", water_density}}}};
    EXPECT_LT(creep(cohesion_for(1.04, unit_weight), water), 1e-3);
    EXPECT_GT(creep(cohesion_for(0.96, unit_weight), water), 0.01);
    EXPECT_GT(creep(cohesion_for(1.04, unit_weight)), 0.1) << "the same soil without water";
}

}  // namespace
}  // namespace mpm::test
