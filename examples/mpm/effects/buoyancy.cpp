#include "effects/effect.hpp"
#include "materials/material.hpp"

#include <stdexcept>

namespace mpm {

namespace {

template <int D>
void build(const EffectBuilder<D>& builder) {
    if (!builder.stages.gravity)
        throw std::invalid_argument("effects / buoyancy: needs the effect gravity");
    const Gravity<D> gravity = *builder.stages.gravity;
    const double share =
        builder.values.number("water_density") / only_density(builder.scene, "buoyancy");
    for (double& component : builder.stages.gravity->acceleration) component *= 1 - share;
    builder.stages.forces.push_back({"buoyancy", [=](GridPatch<D>& patch, const StepTime& step) {
                                         Components<D> lift = gravity.acceleration;
                                         for (double& component : lift)
                                             component *= share * gravity.share_at(step.time);
                                         for (NodeSums<D>& node : patch.sums)
                                             for (std::size_t a = 0; a < D; ++a)
                                                 node.force[a] -= node.mass * lift[a];
                                     }});
}

}  // namespace

/// Reduces gravity to (1 - water / density) by the weight of the displaced water; inertia is
/// unchanged.
EffectKind buoyancy_effect() {
    return {"buoyancy", {not_negative("water_density", "kg/m^3")}, build<2>, build<3>};
}

}  // namespace mpm
