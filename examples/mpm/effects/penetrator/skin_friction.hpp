#pragma once

#include "effects/effect.hpp"

#include <functional>
#include <vector>

namespace mpm {

/// Friction of points along a rigid body.
template <int D>
struct SkinFriction {
    double coefficient = 0;  ///< Coulomb's
    /// Largest shear stress on a point of a block, Pa; none: no limit.
    std::function<double(const Particles&, const PointBlock<D>&, std::size_t)> limit = {};
};

/// Friction as the parameters ask for it.
///
/// Throws std::invalid_argument for two limits, and for a share of the undrained strength where a
/// material has none.
template <int D>
SkinFriction<D> skin_friction(const EffectBuilder<D>& builder);

/// Rules of friction, adhesion and adhesion_factor.
std::vector<Rule> skin_friction_rules();

}  // namespace mpm
