#pragma once

#include "effects/effect.hpp"
#include "effects/penetrator/friction_bands.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace mpm {

/// How points rub along a rigid body.
template <int D>
struct Rubbing {
    double friction = 0;  ///< Coulomb's coefficient
    /// The most shear stress, Pa, of a point of a block; none: no limit.
    std::function<double(const Particles&, const PointBlock<D>&, std::size_t)> limit = {};
};

/// A rigid body among points, and what they push it with.
template <int D>
struct RigidContact {
    Penetrator<D> body;
    Rubbing<D> rubbing;
    std::optional<FrictionBands<D>> bands = {};  ///< where friction has a limit
    double force = 0;       ///< along y on the points of this rank in this step, N
    double next_force = 0;  ///< the same in the next step
};

/// Pushes the points that touch the body out of it: adds columns of the force on each point, sums
/// them on the nodes, and leaves what the body feels in the contact.
///
/// A point is as wide as its volume tells. It loses in a step the velocity it has into the body and
/// takes its overlap back; nothing holds it at the body. Friction is at most that of Coulomb and,
/// where shear stress has a limit, that of its band.
template <int D>
void add_contact(const EffectBuilder<D>& builder, const std::shared_ptr<RigidContact<D>>& contact);

}  // namespace mpm
