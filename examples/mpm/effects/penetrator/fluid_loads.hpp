#pragma once

#include "effects/effect.hpp"
#include "effects/penetrator/penetrator.hpp"

#include <functional>
#include <vector>

namespace mpm {

/// A force on a penetrator along y, N, over a step.
template <int D>
struct BodyLoad {
    std::function<double(const Penetrator<D>&, const StepTime&)> force;
    bool does_return_work = false;  ///< whether the body gets its work back when it moves back
};

/// Forces of still fluid on a penetrator, as far as the parameters ask for them.
///
/// Buoyancy carries the part below `fluid_level`. Drag is density * coefficient * area of the
/// section * speed^2 / 2 while the tip is there. Symmetry cuts a body on a side of the domain.
/// Throws std::invalid_argument for drag without a fluid.
template <int D>
std::vector<BodyLoad<D>> fluid_loads(const EffectBuilder<D>& builder, const Penetrator<D>& body);

/// Rules of fluid_density, fluid_level and drag_coefficient.
std::vector<Rule> fluid_rules();

}  // namespace mpm
