#include <mpm/scene.hpp>

#include <cmath>
#include <stdexcept>

namespace mpm {

namespace {

void require(bool condition, const char* text) {
    if (!condition) throw std::invalid_argument(text);
}

}  // namespace

double Elastic::wave_speed(double density) const {
    return std::sqrt((bulk_modulus() + 4 * shear_modulus() / 3) / density);
}

void validate(const Scene& scene) {
    require(scene.grid.spacing > 0 && std::isfinite(scene.grid.spacing),
            "scene: the grid's spacing must be positive");
    require(scene.grid.num_cells[0] > 0 && scene.grid.num_cells[1] > 0,
            "scene: the grid needs a cell along each axis");
    require(!scene.bodies.empty(), "scene: there is no body");
    for (const Body& body : scene.bodies) {
        require(static_cast<bool>(body.contains), "scene: a body has no shape");
        require(body.points_per_cell[0] > 0 && body.points_per_cell[1] > 0,
                "scene: a body needs at least one point per cell along each axis");
        require(body.density > 0, "scene: the density of a body must be positive");
    }
    require(scene.elastic.youngs_modulus > 0, "scene: Young's modulus must be positive");
    require(scene.elastic.poissons_ratio > -1 && scene.elastic.poissons_ratio < 0.5,
            "scene: Poisson's ratio must lie between -1 and 0.5");
    if (scene.mohr_coulomb) {
        const MohrCoulomb& strength = *scene.mohr_coulomb;
        require(strength.cohesion >= 0, "scene: the cohesion must not be negative");
        require(strength.friction_angle >= 0 && strength.friction_angle < 90,
                "scene: the friction angle must lie between 0 and 90 degrees");
        require(strength.tension_cut_off >= 0, "scene: the tension cut-off must not be negative");
    }
    require(!scene.damping || scene.damping->rate >= 0,
            "scene: the rate of damping must not be negative");
    require(scene.flip_fraction >= 0 && scene.flip_fraction <= 1,
            "scene: the FLIP fraction must lie in 0 ... 1");
    require(scene.courant_number > 0 && scene.courant_number <= 1,
            "scene: the Courant number must lie in 0 ... 1");
}

}  // namespace mpm
