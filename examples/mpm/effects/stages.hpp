#pragma once

#include "transfer/transfers.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mpm {

/// A column of the points that is summed on the nodes into a field of the patch. Each field adds
/// one double per shared node to the messages.
struct NodeField {
    std::string name;
    Column column;
    int component = -1;  ///< component of a vector, whose sign changes in the mirror image of a
                         ///< wall; -1: a scalar
};

/// Acceleration of gravity at its full strength, reduced by buoyancy, m/s^2.
template <int D>
struct Gravity {
    Components<D> acceleration{};
    double ramp = 0;  ///< s

    /// Returns the share of gravity at a time. It grows linearly over the ramp.
    double share_at(double time) const { return time < ramp ? time / ramp : 1; }
};

/// A number that an effect adds to the history; it is the same on all ranks.
struct Report {
    std::string name;
    std::function<double()> value;
};

/// The kernels that effects add to each stage of a step, in the order of the stages.
template <int D>
struct Stages {
    /// called once, when the points are placed
    std::vector<std::function<void(Particles&)>> preparations;
    std::vector<NodeField> fields;                  ///< summed with mass, momentum and force
    std::vector<Named<ScatterKernel<D>>> scatters;  ///< add to the sums of this rank
    std::vector<Named<NodeKernel<D>>> forces;       ///< change the sums over all ranks
    std::vector<Named<NodeKernel<D>>> constraints;  ///< called after all forces
    std::vector<Named<NodeKernel<D>>> moved;        ///< called after the nodes have moved
    /// called when the stresses are the new ones
    std::vector<Named<PointKernel<D>>> after_materials;
    std::vector<Named<StepKernel>> ends;  ///< called after all points have moved
    std::vector<Report> reports;          ///< columns of the history
    /// Numbers other than columns that effects keep between steps. They are the same on all ranks,
    /// and a written state contains them.
    std::vector<double*> kept;
    std::optional<Gravity<D>> gravity;  ///< for the potential energy
    VolumeChange volume_change = VolumeChange::own;
};

}  // namespace mpm
