#include "step/stepper.hpp"

#include <algorithm>

namespace mpm {

namespace {

double layers_of(const Body& body, int dimension) {
    const auto& per_cell = body.points_per_cell;
    return *std::min_element(per_cell.begin(), per_cell.begin() + dimension);
}

/// Whether slopes vanish at the rim as values do: those of quadratic functions, except under a cure
/// of locking, which replaces them by those of a centre.
bool vanish_at_the_rim(const Scene& scene) {
    return scene.shape_function == ShapeFunction::quadratic &&
           find_effect(scene, "locking_cure") == nullptr;
}

/// Scene::least_node_mass, or the least share that keeps layers of points stable.
///
/// A node that only the rim of a layer touches is as stiff as a full one, but light, unless slopes
/// vanish there. In units of cell and wave speed, its frequency squared is 1 / (layers * share of
/// mass). The frequency must stay near 1 per time step beside heavier neighbours and at a corner.
double least_share(const Scene& scene, const Body& body) {
    constexpr double least = 0.01;
    if (scene.least_node_mass > 0) return scene.least_node_mass;
    if (vanish_at_the_rim(scene)) return 0;
    const double courant_number = scene.courant_number;
    return std::max(least, courant_number * courant_number / layers_of(body, scene.dimension));
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
