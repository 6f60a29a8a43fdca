#pragma once

#include "effects/effect.hpp"
#include "effects/penetrator/friction_bands.hpp"

#include <memory>
#include <optional>

namespace mpm {

/// A rigid body among points, and the force between them.
template <int D>
struct RigidContact {
    Penetrator<D> body;
    double friction = 0;                         ///< Coulomb's coefficient
    std::optional<FrictionBands<D>> bands = {};  ///< if friction has a limit
    double force = 0;       ///< along y on the points of all ranks in this step, N
    double last_force = 0;  ///< in the step before, N
    double next_force = 0;  ///< on those of this rank in the next step, N
};

/// Adds the kernels that push the points out of the body.
///
/// They add columns of the force on each point, sum them on the nodes, and leave the force on the
/// points in `contact`. The volume of a point gives its width. Within a contact time a point loses
/// its velocity into the body and half of its overlap. Nothing holds it at the body. Coulomb's law
/// bounds the friction, and so does the share `adhesion_factor` of the undrained strength, by
/// bands, if it is given. Throws std::invalid_argument if a material has no such strength.
template <int D>
void add_contact(const EffectBuilder<D>& builder, const std::shared_ptr<RigidContact<D>>& contact);

}  // namespace mpm
