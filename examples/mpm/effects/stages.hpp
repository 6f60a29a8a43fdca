#pragma once

#include "transfer/transfers.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mpm {

/// A column of the points, summed on the nodes into a field of the patch. It adds one double to the
/// message per shared node.
struct NodeField {
    std::string name;
    Column column;
    /// Weighted by the shape functions' derivatives along it; -1: by themselves; squared_slopes.
    int axis = -1;
    int component = -1;  ///< of a vector, which the mirror image in a wall turns; -1: a scalar
    /// Number of a field before it. Nodes where that is not above 0 need no sum. -1: all nodes do.
    int where = -1;
};

/// Acceleration of weight, buoyancy included, at its full strength, m/s^2.
template <int D>
struct Gravity {
    Components<D> acceleration{};
    double ramp = 0;  ///< s

    /// Share of it that is there at a time: it grows along a straight line over the ramp.
    double share_at(double time) const { return time < ramp ? time / ramp : 1; }
};

/// A number for the history from an effect, the same on all ranks.
struct Report {
    std::string name;
    std::function<double()> value;
};

/// Places of kernels in a step, in its order. An empty stage is a loop over nothing.
template <int D>
struct Stages {
    std::vector<std::function<void(Particles&)>> preparations;  ///< once, of the points in place
    std::vector<NodeField> fields;                       ///< summed with mass, momentum and force
    std::vector<Named<ScatterKernel<D>>> scatters;       ///< to the sums of this rank
    std::vector<Named<NodeKernel<D>>> forces;            ///< on the sums over all ranks
    std::vector<Named<NodeKernel<D>>> constraints;       ///< after all forces
    std::vector<Named<NodeKernel<D>>> moved;             ///< after the nodes have moved
    std::vector<Named<GradientKernel<D>>> gradients;     ///< after points have moved
    std::vector<Named<PointKernel<D>>> after_materials;  ///< stresses are the new ones
    std::vector<Named<StepKernel>> ends;                 ///< after all points have moved
    std::vector<Report> reports;                         ///< for the history
    /// Numbers that effects keep between steps beside columns, the same on all ranks; a written
    /// state contains them.
    std::vector<double*> kept;
    std::optional<Gravity<D>> gravity;  ///< for the potential energy
    VolumeChange volume_change = VolumeChange::own;
};

}  // namespace mpm
