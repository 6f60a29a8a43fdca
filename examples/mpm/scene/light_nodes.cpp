#include "scene/light_nodes.hpp"

#include "materials/elastic.hpp"
#include "transfer/shape_functions.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mpm {

namespace {

/// The largest moduli of the materials, in units of the modulus of the fastest pressure wave.
struct Stiffness {
    double wave_speed = 0;  ///< m/s
    double volume = 0;      ///< D (lambda + 2 G / D), for equal strains along D axes
    double shear = 0;       ///< 2 G, for strains that keep the volume
};

Stiffness stiffness_of(const Scene& scene) {
    Stiffness most;
    for (const Body& body : scene.bodies) {
        const Values values = values_of(scene.materials[material_of(scene, body)], scene.dimension);
        const Elastic elastic = elastic_of(values);
        const double density = values.number("density"), shear = 2 * elastic.shear_modulus();
        const double lambda = elastic.bulk_modulus() - shear / 3;
        most.wave_speed = std::max(most.wave_speed, elastic.wave_speed(density));
        most.volume = std::max(most.volume, (scene.dimension * lambda + shear) / density);
        most.shear = std::max(most.shear, shear / density);
    }
    const double modulus = most.wave_speed * most.wave_speed;
    return {most.wave_speed, most.volume / modulus, most.shear / modulus};
}

/// Sums over the nodes of a point along one axis. "Centre" is that of the points that share the
/// nodes.
struct AxisSums {
    double slopes = 0;          ///< slope^2 / weight
    double centre_slopes = 0;   ///< slope at the centre^2 / weight
    double centre_weights = 0;  ///< weight at the centre^2 / weight
};

template <class Shape>
std::vector<AxisSums> axis_sums(double least_weight) {
    // The last position is near a face, where a quadratic function's outer weight is still above 0.
    constexpr int num_places = 10;
    constexpr double half = 0.5 * (1 - 1e-9);
    constexpr double middle = 0.5 * (Shape::num_nodes - 1);
    const Shape shape(least_weight);
    const auto centre = Shape().at(middle);
    std::vector<AxisSums> all(num_places + 1);
    for (int k = 0; k <= num_places; ++k) {
        const auto at = shape.at(middle + half * k / num_places);
        for (std::size_t n = 0; n < Shape::num_nodes; ++n) {
            all[k].slopes += at.slope[n] * at.slope[n] / at.value[n];
            all[k].centre_slopes += centre.slope[n] * centre.slope[n] / at.value[n];
            all[k].centre_weights += centre.value[n] * centre.value[n] / at.value[n];
        }
    }
    return all;
}

/// Returns the largest mean over the axes of the slope sum along one axis times the weight sums
/// along the others.
double worst_of_centre(const std::vector<AxisSums>& sums, int dimension) {
    double worst = 0;
    for (const AxisSums& x : sums)
        for (const AxisSums& y : sums) {
            const double plane =
                x.centre_slopes * y.centre_weights + y.centre_slopes * x.centre_weights;
            if (dimension == 2) worst = std::max(worst, plane / 2);
            if (dimension == 2) continue;
            for (const AxisSums& z : sums)
                worst = std::max(worst, (plane * z.centre_weights +
                                         z.centre_slopes * x.centre_weights * y.centre_weights) /
                                            3);
        }
    return worst;
}

/// Returns the square of the highest frequency of a single point, times (spacing / wave speed)^2.
template <class Shape>
double point_frequency(const Scene& scene, const Stiffness& stiffness, double least_weight) {
    const std::vector<AxisSums> sums = axis_sums<Shape>(least_weight);
    const double slopes = std::ranges::max(sums, {}, &AxisSums::slopes).slopes;
    const double shear = stiffness.shear * slopes;
    if (find_effect(scene, "locking_cure") == nullptr)
        return std::max(shear, stiffness.volume * slopes);
    return std::max(shear, stiffness.volume * worst_of_centre(sums, scene.dimension));
}

template <class Shape>
StepRule rule_with(const Scene& scene) {
    constexpr double most_per_step = 2;
    constexpr int num_weights = 200;
    const Stiffness stiffness = stiffness_of(scene);
    StepRule rule{stiffness.wave_speed, 0, 0};
    for (int k = 0; k <= num_weights && rule.courant_number < scene.courant_number; ++k) {
        const double weight = Shape::most_least_weight * k / num_weights;
        const double courant =
            std::sqrt(most_per_step / point_frequency<Shape>(scene, stiffness, weight));
        if (courant > rule.courant_number) rule = {stiffness.wave_speed, courant, weight};
    }
    rule.courant_number = std::min(rule.courant_number, scene.courant_number);
    return rule;
}

}  // namespace

StepRule rule_for(const Scene& scene) {
    return scene.shape_function == ShapeFunction::linear ? rule_with<LinearShape>(scene)
                                                         : rule_with<QuadraticShape>(scene);
}

}  // namespace mpm
