#include "scene/scene_reports.hpp"

#include "materials/material.hpp"
#include "scene/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace mpm {

namespace {

/// Difference of the masses by that asked for, from which on there is a warning.
constexpr double tolerated_difference = 0.02;

std::size_t num_axes(const Scene& scene) {
    return static_cast<std::size_t>(scene.dimension);
}

/// Bounds of a body, those of the grid where they are open.
Box closed_bounds(const Scene& scene, const Body& body) {
    Box box = body.bounds;
    const Vector upper = scene.grid.upper();
    for (std::size_t a = 0; a < num_axes(scene); ++a) {
        if (!std::isfinite(box.lower[a])) box.lower[a] = scene.grid.lower[a];
        if (!std::isfinite(box.upper[a])) box.upper[a] = upper[a];
    }
    return box;
}

/// Volume of a body's shapes, by the middles of equal parts of its bounds, m^3; in two dimensions
/// per metre of depth.
double volume_of(const Scene& scene, const Body& body) {
    const int along = scene.dimension == 2 ? 500 : 60;
    const Box box = closed_bounds(scene, body);
    Vector part{1, 1, 1};
    for (std::size_t a = 0; a < num_axes(scene); ++a)
        part[a] = (box.upper[a] - box.lower[a]) / along;
    std::int64_t num_inside = 0;
    for (int k = 0; k < (scene.dimension == 3 ? along : 1); ++k)
        for (int j = 0; j < along; ++j)
            for (int i = 0; i < along; ++i) {
                Vector at{box.lower[0] + (i + 0.5) * part[0], box.lower[1] + (j + 0.5) * part[1],
                          0};
                if (scene.dimension == 3) at[2] = box.lower[2] + (k + 0.5) * part[2];
                num_inside += body.contains(at) ? 1 : 0;
            }
    return static_cast<double>(num_inside) * part[0] * part[1] * part[2];
}

/// Tells a side of the grid that a body reaches beyond; empty where there is none.
std::string side_beyond(const Scene& scene, const Body& body) {
    const Box box = closed_bounds(scene, body);
    const Vector upper = scene.grid.upper();
    const double tolerance = 1e-9 * scene.grid.spacing;
    std::ostringstream text;
    for (std::size_t a = 0; a < num_axes(scene); ++a) {
        if (box.lower[a] < scene.grid.lower[a] - tolerance)
            text << "it reaches down to "
                 << "xyz"[a] << " = " << box.lower[a] << " m, the domain to " << scene.grid.lower[a]
                 << " m";
        else if (box.upper[a] > upper[a] + tolerance)
            text << "it reaches up to "
                 << "xyz"[a] << " = " << box.upper[a] << " m, the domain to " << upper[a] << " m";
        else
            continue;
        break;
    }
    return text.str();
}

std::string warning_of(const Scene& scene, const Body& body, const BodyPoints& points) {
    const std::string place = "bodies / " + body.name + ": ";
    const std::string beyond = side_beyond(scene, body);
    if (!beyond.empty()) return place + beyond + "; make the domain larger or cut the body";
    std::ostringstream text;
    text << place << "its sides cut the lattice of points; put them at multiples of the points' "
         << "distance from the domain's lower corner, which is";
    for (std::size_t a = 0; a < num_axes(scene); ++a)
        text << (a > 0 ? "," : "") << " " << points.spacing[a] << " m along "
             << "xyz"[a];
    text << ", or take smaller cells";
    return text.str();
}

std::string written(double number) {
    std::ostringstream text;
    text << std::setprecision(3) << number;
    return text.str();
}

/// Whether an effect of a scene is of a kind.
bool has_effect(const Scene& scene, const std::string& kind) {
    return std::ranges::any_of(scene.effects, [&](const Effect& effect) {
        return (effect.kind.empty() ? effect.name : effect.kind) == kind;
    });
}

/// Stress that the scene's own weight can cause, Pa; 0 without gravity.
double weight_stress(const Scene& scene, double density) {
    double most = 0;
    for (const Effect& effect : scene.effects)
        if (const auto found = effect.parameters.find("acceleration");
            found != effect.parameters.end())
            for (const double along : std::get<std::vector<double>>(found->second))
                most = std::max(most, std::abs(along));
    return density * most * scene.grid.num_cells[1] * scene.grid.spacing;
}

void append_material_warnings(const Scene& scene, const Material& material,
                              std::vector<std::string>& warnings) {
    const Values values = values_of(material, scene.dimension);
    const std::string place = "materials / " + material.name + ": ";
    const double density = values.number("density");
    const double weight = weight_stress(scene, density);
    if (weight > 0 && (density < 10 || density > 30e3))
        warnings.push_back(place + "the density " + written(density) + " must be in kg/m^3");
    if (weight > values.number("youngs_modulus"))
        warnings.push_back(place + "its weight presses more than the youngs_modulus " +
                           written(values.number("youngs_modulus")) + "; that must be in Pa");
    if (material.model != "drucker_prager") return;
    const double angle = values.number("friction_angle");
    if (angle > 0 && angle < 1.6)
        warnings.push_back(place + "the friction_angle " + written(angle) + " must be in degrees");
    if (angle > 0 && values.number("dilation_angle") == 0 && !has_effect(scene, "locking_cure"))
        warnings.push_back(place +
                           "frictional soil without dilation is too strong by a tenth or "
                           "more, as cells lock; name the effect locking_cure");
}

}  // namespace

std::vector<BodyReport> report_on_bodies(const Scene& scene) {
    std::vector<BodyReport> reports;
    const std::vector<BodyPoints> points = points_of_bodies(scene);
    for (std::size_t b = 0; b < points.size(); ++b) {
        const Body& body = scene.bodies[b];
        const Material& material = scene.materials[material_of(scene, body)];
        const double density = values_of(material, scene.dimension).number("density");
        BodyReport report{body.name, points[b].num_points, density * points[b].volume,
                          density * volume_of(scene, body), ""};
        if (std::abs(report.mass - report.asked_mass) > tolerated_difference * report.asked_mass)
            report.warning = warning_of(scene, body, points[b]);
        reports.push_back(report);
    }
    return reports;
}

double stable_courant_number(const Scene& scene) {
    const bool is_affine = scene.transfer == Transfer::apic;
    if (scene.shape_function == ShapeFunction::linear) return is_affine ? 0.3 : 0.6;
    return is_affine ? 0.8 : 0.7;
}

std::vector<std::string> scene_warnings(const Scene& scene) {
    std::vector<std::string> warnings;
    const double stable = stable_courant_number(scene);
    if (scene.courant_number > stable)
        warnings.push_back("method: the courant_number " + written(scene.courant_number) +
                           " is above " + written(stable) +
                           ", up to which these shape functions and this transfer were found "
                           "stable; lower it");
    for (const Material& material : scene.materials)
        append_material_warnings(scene, material, warnings);
    for (const Probe& probe : scene.probes) {
        const Vector nearest = nearest_point(scene, probe.position);
        const double distance =
            std::hypot(nearest[0] - probe.position[0], nearest[1] - probe.position[1],
                       nearest[2] - probe.position[2]);
        if (distance > scene.grid.spacing)
            warnings.push_back("probes / " + probe.name + ": the nearest point is " +
                               written(distance) + " m away; place it in a body");
    }
    return warnings;
}

std::vector<std::string> damping_notes(const Scene& scene) {
    std::vector<std::string> notes;
    if (scene.flip_fraction == 1 || scene.transfer == Transfer::apic) return notes;
    for (const Material& material : scene.materials) {
        const Values values = values_of(material, scene.dimension);
        const double viscosity = (1 - scene.flip_fraction) * values.number("density") *
                                 find_material_kind(material).wave_speed(values) *
                                 scene.grid.spacing;
        notes.push_back("method: the flip_fraction " + written(scene.flip_fraction) +
                        " is a viscosity of " + written(viscosity) + " Pa s in " + material.name);
    }
    return notes;
}

}  // namespace mpm
