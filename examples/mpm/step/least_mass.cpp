#include "step/stepper.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

/// Least share of a full node's mass: 0, except under a cure of locking, which replaces the slopes
/// at points by those of a centre.
///
/// A point in a corner of a cell then has a node that is light but not soft. With n points along a
/// cell the point has 1/n^2 of a full node's mass, and the square of that node's frequency is at
/// most 1/4 per step. More would give energy: strains lack what nodes gain (least_mass_test).
double least_share(const Scene& scene, const Body& body) {
    const auto& per_cell = body.points_per_cell;
    const int layers = *std::min_element(per_cell.begin(), per_cell.begin() + scene.dimension);
    return 2 * std::pow(scene.courant_number / layers, 2);
}

}  // namespace

template <int D>
LeastMass add_least_mass(const Scene& scene, Column mass, Stages<D>& stages) {
    LeastMass least;
    if (stages.volume_change == VolumeChange::own) return least;
    bool differ = false;
    for (const Body& body : scene.bodies) {
        double full = density_of(scene.materials[material_of(scene, body)], D);
        differ |= full != density_of(scene.materials.front(), D);
        for (int a = 0; a < D; ++a) full *= scene.grid.spacing;
        least.everywhere = std::max(least.everywhere, least_share(scene, body) * full);
    }
    if (!differ) return least;
    // At most C^2 times the field is what a node's stiffness takes in a step, so that the square of
    // a light node's frequency is at most 1 per step, whatever points of which density reach it.
    least.factor = std::pow(scene.courant_number, 2);
    least.field = stages.fields.size();
    stages.fields.push_back({"least_mass", mass, squared_centre_slopes});
    return least;
}

template LeastMass add_least_mass<2>(const Scene&, Column, Stages<2>&);
template LeastMass add_least_mass<3>(const Scene&, Column, Stages<3>&);

}  // namespace mpm
