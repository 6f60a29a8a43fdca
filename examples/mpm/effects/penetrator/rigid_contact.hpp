#pragma once

#include "effects/effect.hpp"
#include "effects/penetrator/friction_bands.hpp"
#include "effects/penetrator/skin_friction.hpp"

#include <memory>
#include <optional>

namespace mpm {

/// A rigid body among points, and the force between them.
template <int D>
struct RigidContact {
    Penetrator<D> body;
    SkinFriction<D> skin;
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
