#pragma once

#include "transfer/kernels.hpp"

#include <functional>
#include <optional>
#include <span>
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
};

/// Acceleration of weight, buoyancy included, at its full strength, m/s^2.
template <int D>
struct Gravity {
    Components<D> acceleration{};
    double ramp = 0;  ///< s until it is there; 0: at once

    double share_at(double time) const { return time < ramp ? time / ramp : 1; }
};

/// A number for the history from an effect, the same on all ranks.
struct Report {
    std::string name;
    std::function<double()> value;
};

/// Energies of a rigid body, J, the same on all ranks.
struct RigidEnergy {
    double kinetic;
    double potential;  ///< 0 at the start
};

/// Numbers that an effect keeps between steps beside columns; a written state holds them.
struct EffectState {
    std::function<std::vector<double>()> save;
    std::function<void(std::span<const double>)> load;  ///< as many as save gives
    bool is_sum;  ///< whether the ranks' numbers add up; otherwise they are the same on all
};

/// Work of the stress in each point since the start, J.
struct WorkColumns {
    Column internal;  ///< on all strain
    Column plastic;   ///< on plastic strain
};

/// Places of kernels in a step, in its order. An empty stage is a loop over nothing.
template <int D>
struct Stages {
    std::vector<std::function<void(Particles&)>> preparations;  ///< once, of the points in place
    std::vector<NodeField> fields;                        ///< summed with mass, momentum and force
    std::vector<Named<ScatterKernel<D>>> scatters;        ///< to the sums of this rank
    std::vector<Named<NodeKernel<D>>> forces;             ///< on the sums over all ranks
    std::vector<Named<NodeKernel<D>>> constraints;        ///< after all forces
    std::vector<Named<NodeKernel<D>>> moved;              ///< after the nodes have moved
    std::vector<Named<GradientKernel<D>>> gradients;      ///< after points have moved
    std::vector<Named<PointKernel<D>>> before_materials;  ///< stresses are the old ones
    std::vector<Named<PointKernel<D>>> after_materials;   ///< stresses are the new ones
    std::vector<Named<StepKernel>> ends;                  ///< after all points have moved
    /// Energies that were lost on this rank since the start, J. Valid between steps.
    std::vector<std::function<double(const Particles&)>> dissipated;
    /// Energy that the transfers have lost on this rank since the start, J; none: nobody asks.
    /// What internal work neither is plastic nor stored comes on top.
    std::function<double(const Particles&)> transfer_loss = {};
    std::vector<std::function<RigidEnergy()>> rigid_energies = {};  ///< added to the points'
    std::vector<Report> reports = {};                               ///< for the history
    std::vector<EffectState> states = {};
    std::optional<WorkColumns> work = {};
    std::optional<Gravity<D>> gravity = {};  ///< for the potential energy
    bool counts_nodes = false;               ///< asks for GridPatch::is_counted
    bool carries_motion = false;  ///< asks for the last step's GridPatch::motion after a rebalance
};

}  // namespace mpm
