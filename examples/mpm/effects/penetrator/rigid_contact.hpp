#pragma once

#include "effects/effect.hpp"
#include "effects/penetrator/friction_bands.hpp"
#include "effects/penetrator/skin_friction.hpp"
#include "effects/point_contact.hpp"

#include <memory>
#include <optional>

namespace mpm {

/// A rigid body among points, and the force between them.
template <int D>
struct RigidContact {
    Penetrator<D> body;
    SkinFriction<D> skin;
    ContactTimes times;
    std::optional<FrictionBands<D>> bands = {};  ///< where friction has a limit
    double force = 0;       ///< along y on the points of this rank in this step, N
    double next_force = 0;  ///< the same in the next step
};

/// Adds the kernels that push the points out of the body.
///
/// They add columns of the force on each point, sum them on the nodes, and leave the force on the
/// body in `contact`. The volume of a point tells its width. Within a contact time a point loses
/// its velocity into the body and part of its overlap. Nothing holds it at the body. Coulomb's law
/// bounds the friction, and so does the limit of shear stress, by bands, where there is one.
template <int D>
void add_contact(const EffectBuilder<D>& builder, const std::shared_ptr<RigidContact<D>>& contact);

}  // namespace mpm
