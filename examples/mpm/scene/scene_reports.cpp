#include "scene/scene_reports.hpp"

#include "materials/material.hpp"
#include "scene/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

namespace mpm {

namespace {

std::string written(double number) {
    std::ostringstream text;
    text << std::setprecision(3) << number;
    return text.str();
}

/// Returns the stress that the weight of the scene can cause, Pa; 0 without gravity.
double weight_stress(const Scene& scene, double density) {
    const Effect* gravity = find_effect(scene, "gravity");
    if (gravity == nullptr) return 0;
    double most = 0;
    for (const double along : std::get<std::vector<double>>(gravity->parameters.at("acceleration")))
        most = std::max(most, std::abs(along));
    return density * most * scene.grid.num_cells[1] * scene.grid.spacing;
}

using Warnings = std::vector<std::string>;

/// Checks whether soil can be at rest. If both lateral stresses are equal, the cone is inside
/// Mohr-Coulomb's pyramid.
void check_rest(const Scene& scene, const Values& soil, const std::string& place, double weight,
                Warnings& warnings) {
    const Effect* geostatic = find_effect(scene, "geostatic");
    if (geostatic == nullptr) return;
    const auto given = geostatic->parameters.find("lateral_ratio");
    const double ratio = given == geostatic->parameters.end() ? 1 : std::get<double>(given->second);
    const double angle = soil.number("friction_angle") * std::numbers::pi / 180;
    const double sine = std::sin(angle), root = std::numbers::sqrt3;
    const double strength = soil.number("cohesion") * std::cos(angle);
    if ((1 - ratio) / root * weight - sine * (1 + 2 * ratio) / 3 * weight > strength)
        warnings.push_back("effects / geostatic: at the lateral_ratio " + written(ratio) + ", " +
                           place + "yields at rest; without cohesion it needs " +
                           written((root - sine) / (root + 2 * sine)));
}

void check_material(const Scene& scene, const Material& material, Warnings& warnings) {
    const Values values = values_of(material, scene.dimension);
    const std::string place = "materials / " + material.name + ": ";
    const double density = values.number("density");
    const double weight = weight_stress(scene, density);
    if (weight > 0 && (density < 10 || density > 30e3))
        warnings.push_back(place + "the density " + written(density) + " must be in kg/m^3");
    if (weight > 2 * values.number("youngs_modulus"))
        warnings.push_back(place + "its weight presses more than twice the youngs_modulus " +
                           written(values.number("youngs_modulus")) + "; that must be in Pa");
    if (material.model != "drucker_prager") return;
    const double angle = values.number("friction_angle");
    if (angle > 0 && angle < 1.6)
        warnings.push_back(place + "the friction_angle " + written(angle) + " must be in degrees");
    if (angle > 0 && find_effect(scene, "locking_cure") == nullptr)
        warnings.push_back(place +
                           "frictional soil without dilation is too strong by a tenth or "
                           "more, as cells lock; name the effect locking_cure");
    check_rest(scene, values, place, weight, warnings);
}

void check_bounds(const Scene& scene, const Body& body, Warnings& warnings) {
    const Vector upper = scene.grid.upper();
    const double tolerance = 1e-9 * scene.grid.spacing;
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a)
        for (const double bound : {body.bounds.lower[a], body.bounds.upper[a]})
            if (std::isfinite(bound) &&
                (bound < scene.grid.lower[a] - tolerance || bound > upper[a] + tolerance))
                warnings.push_back("bodies / " + body.name + ": it reaches to " + "xyz"[a] + " = " +
                                   written(bound) +
                                   " m, beyond the domain; make that larger or cut the body");
}

/// Volume of a body in the domain, m^3, to some thousandths; in two dimensions its area, m^2.
double volume_of(const Scene& scene, const Body& body) {
    // Roberts' sequence, which fills a box evenly: powers of the inverse of the root of x^4 = x
    // + 1.
    constexpr Vector strides{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    constexpr int num_samples = 1 << 16;
    const auto dimension = static_cast<std::size_t>(scene.dimension);
    const Vector domain_upper = scene.grid.upper();
    Vector lower{}, width{};
    double volume = 1;
    for (std::size_t a = 0; a < dimension; ++a) {
        lower[a] = std::max(body.bounds.lower[a], scene.grid.lower[a]);
        width[a] = std::min(body.bounds.upper[a], domain_upper[a]) - lower[a];
        volume *= width[a];
    }
    int num_inside = 0;
    for (int k = 0; k < num_samples; ++k) {
        Vector at{};
        for (std::size_t a = 0; a < dimension; ++a)
            at[a] = lower[a] + width[a] * std::fmod(0.5 + k * strides[a], 1.0);
        num_inside += body.contains(at) ? 1 : 0;
    }
    return volume * num_inside / num_samples;
}

/// Points stand for equal volumes: together they may have more or less than the body.
void check_masses(const Scene& scene, Warnings& warnings) {
    constexpr double tolerance = 0.02;
    std::vector<double> volumes(scene.bodies.size());
    visit_points(scene, [&](const Body& body, const Vector&, std::int64_t) {
        const Vector size = lattice_spacing(scene, body);
        volumes[static_cast<std::size_t>(&body - scene.bodies.data())] +=
            size[0] * size[1] * size[2];
    });
    for (std::size_t b = 0; b < volumes.size(); ++b) {
        const Body& body = scene.bodies[b];
        const double exact = volume_of(scene, body), excess = volumes[b] / exact - 1;
        if (std::abs(excess) <= tolerance) continue;
        const double density =
            density_of(scene.materials[material_of(scene, body)], scene.dimension);
        warnings.push_back("bodies / " + body.name + ": its points weigh " +
                           written(density * volumes[b]) + " kg, its shape " +
                           written(density * exact) +
                           " kg; place its sides midway between points, or take more "
                           "points_per_cell");
    }
}

void check_probe(const Scene& scene, const Probe& probe, Warnings& warnings) {
    const Vector nearest = nearest_point(scene, probe.position).place;
    const double distance =
        std::hypot(nearest[0] - probe.position[0], nearest[1] - probe.position[1],
                   nearest[2] - probe.position[2]);
    if (distance > scene.grid.spacing)
        warnings.push_back("probes / " + probe.name + ": the nearest point is " +
                           written(distance) + " m away; place it in a body");
}

}  // namespace

double stable_courant_number(const Scene& scene) {
    return scene.shape_function == ShapeFunction::linear ? 0.4 : 0.6;
}

std::vector<std::string> scene_warnings(const Scene& scene) {
    Warnings warnings;
    const double stable = stable_courant_number(scene);
    if (scene.courant_number > stable)
        warnings.push_back("method: the courant_number " + written(scene.courant_number) +
                           " is above " + written(stable) +
                           ", up to which these shape functions were found stable; lower it");
    if (scene.dimension == 2 && find_effect(scene, "penetrator") != nullptr)
        warnings.push_back(
            "effects / penetrator: in two dimensions it is a plate without an end, "
            "not a cylinder; take depths from three");
    for (const Material& material : scene.materials) check_material(scene, material, warnings);
    for (const Body& body : scene.bodies) check_bounds(scene, body, warnings);
    check_masses(scene, warnings);
    for (const Probe& probe : scene.probes) check_probe(scene, probe, warnings);
    return warnings;
}

}  // namespace mpm
