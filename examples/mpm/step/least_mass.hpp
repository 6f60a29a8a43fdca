#pragma once

#include "effects/stages.hpp"

namespace mpm {

/// Least mass of the nodes of a scene (Scene::least_node_mass). Where bodies differ in density it
/// adds a field of the nodes, so that each node goes by the points that touch it.
template <int D>
LeastMass add_least_mass(const Scene& scene, Column mass, Stages<D>& stages);

}  // namespace mpm
