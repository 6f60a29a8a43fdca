#pragma once

#include <mpm/scene.hpp>

#include <cmath>

namespace mpm::test {

/// The slope of scenes/slope.yaml in cells of another size, without a scene file.
///
/// Crest at y = 20 m from x = 0 to 30, a 45 degree face to the toe at (50, 0), ground to x = 110,
/// base at y = -15. Each cell holds 5 x 4 points. With 116 cells across, of 0.948 m, there are
/// 54,464 points. No other whole number of cells with a nearly square lattice comes nearer to the
/// paper's 54,440.
inline Scene slope_scene(int cells_across = 116) {
    constexpr double length = 110, crest = 20, base = -15, crest_end = 30, toe = 50;
    const auto ground = [](double x) {
        if (x <= crest_end) return crest;
        return x < toe ? toe - x : 0;
    };
    const double spacing = length / cells_across;
    const Body soil{.contains = [=](const Vector& at) { return at[1] <= ground(at[0]); },
                    .points_per_cell = {5, 4, 1},
                    .material = "soil"};
    const int cells_up = static_cast<int>(std::ceil((crest - base) / spacing)) + 1;
    return {
        .name = "slope",
        .grid = {.lower = {0, base}, .spacing = spacing, .num_cells = {cells_across, cells_up}},
        .materials = {{"soil",
                       "drucker_prager",
                       {{"density", 2100.0},
                        {"youngs_modulus", 70e6},
                        {"poissons_ratio", 0.3},
                        {"cohesion", 10e3},
                        {"friction_angle", 20.0},
                        {"tension_cut_off", 27.48e3}}}},
        .bodies = {soil},
        .walls = {.left = Wall::roller, .right = Wall::roller, .bottom = Wall::fixed},
        .effects = {{"gravity", {{"acceleration", std::vector<double>{0, -9.81}}, {"ramp", 1.0}}},
                    {"locking_cure", {}}},
        .end_time = 8};
}

}  // namespace mpm::test
