#include "scene/lattice.hpp"
#include "step/stepper.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

/// Least mass of nodes that points of a body reach, kg, under a cure of locking, which replaces the
/// slopes at points by those of a centre.
///
/// A point in a corner of a cell then has a node that is light but not soft. With n points along a
/// cell the point has 1/n^2 of a full node's mass, and the square of that node's frequency is at
/// most 1/4 per step. More would give energy: strains lack what nodes gain (least_mass_test).
double least_mass_of(const Scene& scene, const Body& body) {
    const auto& per_cell = body.points_per_cell;
    const int layers = *std::min_element(per_cell.begin(), per_cell.begin() + scene.dimension);
    return 2 * std::pow(scene.courant_number / layers, 2) *
           density_of(scene.materials[material_of(scene, body)], scene.dimension) *
           std::pow(scene.grid.spacing, scene.dimension);
}

}  // namespace

template <int D>
LeastMass add_least_mass(const Scene& scene, Particles& particles, Stages<D>& stages) {
    LeastMass least;
    if (stages.volume_change == VolumeChange::own) return least;
    std::vector<double> of_bodies;
    for (const Body& body : scene.bodies) of_bodies.push_back(least_mass_of(scene, body));
    const auto [lowest, highest] = std::ranges::minmax(of_bodies);
    least.everywhere = highest;
    if (lowest == highest) return least;
    // A node takes the largest of the bodies that reach it. Fields are sums over the ranks: the
    // eighth root of a sum of eighth powers is between the largest and twice that.
    const Column power = particles.add_column("least_mass");
    least.field = stages.fields.size();
    stages.fields.push_back({"least_mass", power, on_each_node});
    stages.preparations.push_back([=, places = StartPlaces(scene)](Particles& points) {
        const std::span<const double> ids = points["id"];
        for (std::size_t p = 0; p < points.size(); ++p)
            points.data(power)[p] = std::pow(of_bodies[places.body_of(ids[p])] / highest, 8);
    });
    return least;
}

template LeastMass add_least_mass<2>(const Scene&, Particles&, Stages<2>&);
template LeastMass add_least_mass<3>(const Scene&, Particles&, Stages<3>&);

}  // namespace mpm
