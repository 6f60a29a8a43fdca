#include "support.hpp"

#include <gtest/gtest.h>

namespace mpm::test {
namespace {

constexpr double height = 0.1, density = 1800, gravity = 9.81, modulus = 1e6;

/// A column under its weight between rollers, damped near its critical rate, 2 * pi c / (2 H),
/// so that the oscillation that sudden gravity starts is gone after a tenth of a second.
Scene column(int cells_up) {
    const double spacing = height / cells_up;
    return {
        .name = "column",
        .grid = {.lower = {0, 0}, .spacing = spacing, .num_cells = {2 * cells_up, cells_up + 2}},
        .materials = {elastic_material("soil", density, modulus, 0)},
        .bodies = {{.contains = half_space_region({0, height}, {0, 1}),
                    .points_per_cell = {2, 2, 1},
                    .material = "soil"}},
        .walls = {.left = Wall::roller, .right = Wall::roller, .bottom = Wall::fixed},
        .effects = {gravity_effect(gravity), {"damping", {{"rate", 740.0}, {"until", 1.0}}}}};
}

/// Largest error of the vertical stress at the points' own depths, by the stress at the base.
double error_of(int cells_up) {
    Simulation simulation(column(cells_up), MPI_COMM_WORLD);
    while (simulation.time() < 0.1) simulation.step();
    const std::vector<double> y = gathered(simulation, "y", MPI_COMM_WORLD);
    const std::vector<double> stress = gathered(simulation, "stress_yy", MPI_COMM_WORLD);
    const double surface = *std::ranges::max_element(y) + height / cells_up / 4;
    double worst = 0;
    for (std::size_t p = 0; p < y.size(); ++p)
        worst = std::max(worst, std::abs(stress[p] + density * gravity * (surface - y[p])));
    return worst / (density * gravity * height);
}

// A cell of linear shape functions has one vertical strain, so its points share the stress of the
// cell's middle: at two points across a cell, a quarter cell off. First order, h / 4 H, beside
// what the compression of the column changes: some of its strain, rho g H / E = 0.0018.
TEST(HydrostaticColumn, has_the_weight_above_each_point) {
    const double coarse = error_of(8), fine = error_of(16);
    const double strain = density * gravity * height / modulus;
    EXPECT_NEAR(coarse, 0.25 / 8, 1.5 * strain);
    EXPECT_NEAR(fine, 0.25 / 16, 1.5 * strain);
    EXPECT_NEAR(coarse / fine, 2, 0.2);
}

}  // namespace
}  // namespace mpm::test
