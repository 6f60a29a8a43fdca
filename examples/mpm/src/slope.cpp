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
    const Body soil{.contains = [=](double x, double y) { return y <= ground(x) + tolerance; },
                    .points_per_cell = {5, 4},
                    .density = 2100};
    const int cells_up = static_cast<int>(std::ceil((crest - base) / spacing)) + 1;
    return {.name = "slope",
            .grid = {.lower = {0, base}, .spacing = spacing, .num_cells = {cells_across, cells_up}},
            .bodies = {soil},
            .walls = {.left = Wall::roller, .right = Wall::roller, .bottom = Wall::fixed},
            .elastic = {.youngs_modulus = 70e6, .poissons_ratio = 0.3},
            .mohr_coulomb =
                MohrCoulomb{.cohesion = 10e3, .friction_angle = 20, .tension_cut_off = 27.48e3},
            .gravity = Vector{0, -9.81},
            .end_time = 8};
}

}  // namespace mpm
