#pragma once

#include "effects/effect.hpp"

#include <functional>
#include <vector>

namespace mpm {

/// Friction of points along a rigid body.
template <int D>
struct SkinFriction {
    double coefficient = 0;  ///< Coulomb's
    /// The most shear stress, Pa, of a point of a block; none: no limit.
    std::function<double(const Particles&, const PointBlock<D>&, std::size_t)> limit = {};
};

/// Friction as the parameters ask for it.
///
/// Throws std::invalid_argument for two limits, and where a share of the undrained strength is
/// asked for of a material without one.
template <int D>
SkinFriction<D> skin_friction(const EffectBuilder<D>& builder);

/// Rules of friction, adhesion and adhesion_factor.
std::vector<Rule> skin_friction_rules();

}  // namespace mpm
