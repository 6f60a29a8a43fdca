#pragma once

#include "transfer/transfers.hpp"

#include <memory>
#include <span>

namespace mpm {

/// Map of the velocities of points back to the nodes: the modified update stress last of Sulsky,
/// Zhou and Schreyer (1995) strains the points by these.
///
/// The velocities are those at the end of the step. So a node with next to no mass moves as the
/// points around it, however large its acceleration.
template <int D>
class VelocityRemap {
  public:
    virtual ~VelocityRemap() = default;

    /// Overwrites the momenta of a patch with those that this rank's points will have at the end of
    /// the step, by the shape functions of its start.
    virtual void scatter(const Particles& particles, std::span<const CellRun<D>> runs,
                         double time_step, GridPatch<D>& patch) const = 0;
};

/// Velocity remap of a scene, or none where it asks for none.
template <int D>
std::unique_ptr<VelocityRemap<D>> make_velocity_remap(const Scene& scene, const FlipShare& flip,
                                                      Particles& particles);

/// Sets the velocities that strain the points by the momenta of a patch, summed over the ranks.
template <int D>
void strain_by_momentum(GridPatch<D>& patch);

}  // namespace mpm
