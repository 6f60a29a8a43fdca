#pragma once

#include "effects/effect.hpp"
#include "effects/penetrator/friction_bands.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace mpm {

/// Friction of points along a rigid body.
template <int D>
struct Rubbing {
    double friction = 0;  ///< Coulomb's coefficient
    /// The most shear stress, Pa, of a point of a block; none: no limit.
    std::function<double(const Particles&, const PointBlock<D>&, std::size_t)> limit = {};
};

/// A rigid body among points, and the force between them.
template <int D>
struct RigidContact {
    Penetrator<D> body;
    Rubbing<D> rubbing;
    std::optional<FrictionBands<D>> bands = {};  ///< where friction has a limit
    double force = 0;       ///< along y on the points of this rank in this step, N
    double next_force = 0;  ///< the same in the next step
};

/// Adds the kernels that push the points out of the body.
///
/// They add columns of the force on each point, sum them on the nodes, and leave the force on the
/// body in `contact`. A point is as wide as its volume tells. In a step it loses its velocity into
/// the body and takes its overlap back; nothing holds it at the body. Coulomb bounds the friction
/// and, where shear stress has a limit, so does its band.
template <int D>
void add_contact(const EffectBuilder<D>& builder, const std::shared_ptr<RigidContact<D>>& contact);

}  // namespace mpm
