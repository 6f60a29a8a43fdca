#include "effects/effect.hpp"

#include <cmath>

namespace mpm {

namespace {

template <int D>
void build(const EffectBuilder<D>& builder) {
    const double fraction = builder.values.number("fraction");
    const double until = builder.values.number("until");
    builder.stages.forces.push_back(
        {"local_damping", [=](GridPatch<D>& patch, const StepTime& step) {
             if (step.time >= until) return;
             for (NodeSums<D>& node : patch.sums)
                 for (std::size_t a = 0; a < D; ++a) {
                     const double resistance = fraction * std::abs(node.force[a]);
                     if (node.momentum[a] != 0)
                         node.force[a] -= std::copysign(resistance, node.momentum[a]);
                 }
         }});
}

}  // namespace

/// A share of each unbalanced force acts against the motion until a time (Cundall 1987). Where
/// forces balance it holds nothing back, so points soon rest under their weight.
EffectKind local_damping_effect() {
    return {"local_damping",
            {within("fraction", "", 0, 0.99), not_negative("until", "s")},
            build<2>,
            build<3>};
}

}  // namespace mpm
