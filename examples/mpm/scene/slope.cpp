#include <mpm/slope.hpp>

#include <cmath>

namespace mpm {

namespace {

constexpr double length = 110, crest = 20, base = -15, crest_end = 30, toe = 50;

double ground(double x) {
    if (x <= crest_end) return crest;
    return x < toe ? toe - x : 0;
}

}  // namespace

Scene slope_scene(int cells_across) {
    const double spacing = length / cells_across;
    // Lattice points on the face itself belong to the slope, whatever the rounding.
    const double tolerance = 1e-9 * spacing;
    const Body soil{
        .contains = [=](const Vector& at) { return at[1] <= ground(at[0]) + tolerance; },
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

}  // namespace mpm
