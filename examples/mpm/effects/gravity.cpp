#include "effects/effect.hpp"

#include <algorithm>

namespace mpm {

namespace {

template <int D>
void build(const EffectBuilder<D>& builder) {
    Gravity<D>& gravity = builder.stages.gravity.emplace();
    std::copy_n(builder.values.list("acceleration").begin(), D, gravity.acceleration.begin());
    gravity.ramp = builder.values.number("ramp");
    builder.stages.forces.push_back(
        {"gravity", [gravity](GridPatch<D>& patch, const StepTime& step) {
             Components<D> pull = gravity.acceleration;
             for (double& component : pull) component *= gravity.share_at(step.time);
             for (NodeSums<D>& node : patch.sums)
                 for (std::size_t a = 0; a < D; ++a) node.force[a] += node.mass * pull[a];
         }});
}

}  // namespace

/// Applies gravity, at full strength from the start or after a ramp.
EffectKind gravity_effect() {
    return {"gravity",
            {vector("acceleration", "m/s^2"), not_negative("ramp", "s", 0.0)},
            build<2>,
            build<3>};
}

}  // namespace mpm
