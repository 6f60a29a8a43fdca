#include "effects/effect.hpp"
#include "materials/material.hpp"

#include <mpm/scene.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace mpm {

namespace {

void require(bool condition, const std::string& text) {
    if (!condition) throw std::invalid_argument("scene: " + text);
}

void check_grid(const Scene& scene) {
    constexpr double most_cells = 1e9;
    double num_cells = 1;
    require(scene.dimension == 2 || scene.dimension == 3, "the dimension must be 2 or 3");
    require(scene.grid.spacing > 0 && std::isfinite(scene.grid.spacing),
            "the size of a cell must be positive");
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a) {
        require(std::isfinite(scene.grid.lower[a]), "the domain must have a finite lower corner");
        require(scene.grid.num_cells[a] > 0, "the domain needs a cell along each axis");
        num_cells *= scene.grid.num_cells[a];
    }
    require(num_cells <= most_cells, "the domain has more than 1e9 cells; take larger ones");
}

void check_body(const Scene& scene, const Body& body) {
    require(static_cast<bool>(body.contains), "a body has no shape");
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a)
        require(body.points_per_cell[a] > 0,
                "a body needs at least one point per cell along each axis");
    material_of(scene, body);
}

void check_friction(double friction, const std::string& place) {
    require(friction >= 0 && std::isfinite(friction),
            "the friction of " + place + " must not be negative");
}

void check_plane(const Scene& scene, const Plane& plane) {
    const std::string place = "plane '" + plane.name + "'";
    double square = 0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a) {
        square += plane.normal[a] * plane.normal[a];
        require(std::isfinite(plane.point[a]), place + " must have a finite point");
    }
    require(square > 0 && std::isfinite(square), place + " must have a normal that is not zero");
    check_friction(plane.friction, place);
}

/// Throws if a parameter is given without the other one that makes use of it.
void check_partners(const Material& material) {
    if (material.parameters.contains("softening_strain") &&
        !material.parameters.contains("residual_ratio"))
        throw std::invalid_argument("materials / " + material.name +
                                    ": 'softening_strain' has no effect without 'residual_ratio'");
}

/// Throws unless all effects of water have the same density.
void check_water(const std::vector<NamedEffect>& effects) {
    double density = 0;
    for (const NamedEffect& effect : effects)
        for (const char* key : {"water_density", "fluid_density"}) {
            const double own = effect.values.has(key) ? effect.values.number(key) : 0;
            require(own == 0 || density == 0 || own == density,
                    "effects / " + effect.kind->name + ": '" + key +
                        "' must be the density of water of the other effects");
            density = std::max(density, own);
        }
}

/// Throws if the name of a probe contains a character that the table cannot contain.
void check_probe(const Probe& probe) {
    const auto may_stand = [](unsigned char character) {
        return std::iscntrl(character) == 0 && character != ',' && character != '"';
    };
    const std::string place = "probe '" + probe.name + "'";
    require(std::ranges::all_of(probe.name, may_stand),
            place + " must have a name of one line without commas and quotes");
    for (const double coordinate : probe.position)
        require(std::isfinite(coordinate), place + " must have a finite position");
}

}  // namespace

const Effect* find_effect(const Scene& scene, const std::string& name) {
    const auto found = std::ranges::find(scene.effects, name, &Effect::name);
    return found == scene.effects.end() ? nullptr : &*found;
}

void validate(const Scene& scene) {
    check_grid(scene);
    require(!scene.bodies.empty(), "there is no body");
    for (const Material& material : scene.materials) {
        values_of(material, scene.dimension);
        check_partners(material);
    }
    for (const Body& body : scene.bodies) check_body(scene, body);
    const Walls& walls = scene.walls;
    for (const Wall* wall :
         {&walls.left, &walls.right, &walls.bottom, &walls.top, &walls.back, &walls.front})
        check_friction(wall->friction, "a wall");
    for (const Plane& plane : scene.planes) check_plane(scene, plane);
    for (const Probe& probe : scene.probes) check_probe(probe);
    require(scene.courant_number > 0 && scene.courant_number <= 1,
            "the Courant number must lie in 0 ... 1");
    check_water(effects_of(scene));
}

}  // namespace mpm
