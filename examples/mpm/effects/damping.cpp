#include "effects/effect.hpp"

#include <cmath>

namespace mpm {

namespace {

template <int D>
void build(const EffectBuilder<D>& builder) {
    const double rate = builder.values.number("rate"), until = builder.values.number("until");
    builder.stages.forces.push_back({"damping", [=](GridPatch<D>& patch, const StepTime& step) {
                                         if (step.time >= until) return;
                                         const double share = -std::expm1(-rate * step.time_step);
                                         for (NodeSums<D>& node : patch.sums)
                                             for (std::size_t a = 0; a < D; ++a)
                                                 node.force[a] -=
                                                     share / step.time_step * node.momentum[a];
                                     }});
}

}  // namespace

/// Makes momentum decay by exp(-rate * time) until a given time, so that a simulation can start
/// from rest. It is stable at any rate.
EffectKind damping_effect() {
    return {
        "damping", {not_negative("rate", "1/s"), not_negative("until", "s")}, build<2>, build<3>};
}

}  // namespace mpm
