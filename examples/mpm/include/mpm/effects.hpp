#pragma once

#include <mpm/drucker_prager.hpp>
#include <mpm/elastic.hpp>
#include <mpm/grid.hpp>
#include <mpm/transfer.hpp>

#include <string>
#include <vector>

namespace mpm {

NodeKernel gravity_kernel(const Vector& acceleration);
NodeKernel damping_kernel(const Damping& damping);
NodeKernel wall_kernel(const Walls& walls);
PointKernel elastic_kernel(const Elastic& elastic, const StressColumns& columns);
PointKernel drucker_prager_kernel(const DruckerPrager& cone, const StressColumns& columns);

template <typename Kernel>
struct Named {
    std::string name;
    Kernel kernel;
};

/// The kernels a scene asks for in their order, and no others.
struct Effects {
    std::vector<Named<NodeKernel>> nodes;    ///< on the summed nodes, before they move
    std::vector<Named<PointKernel>> points;  ///< on the points, after they have moved
};

/// Builds the kernels of a scene; each adds the columns it needs.
Effects build_effects(const Scene& scene, Particles& particles);

}  // namespace mpm
