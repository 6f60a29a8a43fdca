#include "step/stepper.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

double layers_of(const Body& body, int dimension) {
    const auto& per_cell = body.points_per_cell;
    return *std::min_element(per_cell.begin(), per_cell.begin() + dimension);
}

/// Least share of a full node's mass: 0, except under a cure of locking, which replaces the slopes
/// at points by those of a centre.
///
/// A point in a corner of a cell then has a node that is light but not soft. With n points along a
/// cell the point has 1/n^2 of a full node's mass, and the square of that node's frequency is at
/// most 1/4 per step. More would give energy: strains lack what nodes gain (least_mass_test).
double least_share(const Scene& scene, const Body& body) {
    if (find_effect(scene, "locking_cure") == nullptr) return 0;
    return 2 * std::pow(scene.courant_number / layers_of(body, scene.dimension), 2);
}

}  // namespace

template <int D>
LeastMass add_least_mass(const Scene& scene, Column mass, Stages<D>& stages) {
    LeastMass least;
    bool differ = false;
    for (const Body& body : scene.bodies) {
        double full = density_of(scene.materials[material_of(scene, body)], D);
        differ |= full != density_of(scene.materials.front(), D);
        for (int a = 0; a < D; ++a) full *= scene.grid.spacing;
        const double share = least_share(scene, body);
        least.everywhere = std::max(least.everywhere, share * full);
        // A layer of points across a cell has the mass full / layers, and slopes of 1 per cell.
        least.factor = std::max(least.factor, share * layers_of(body, D));
    }
    if (!differ || least.everywhere == 0) return least;
    least.field = stages.fields.size();
    stages.fields.push_back({"least_mass", mass, squared_slopes});
    return least;
}

template LeastMass add_least_mass<2>(const Scene&, Column, Stages<2>&);
template LeastMass add_least_mass<3>(const Scene&, Column, Stages<3>&);

}  // namespace mpm
