#include "boundaries/contact.hpp"
#include "effects/effect.hpp"

#include <cmath>

namespace mpm {

namespace {

/// Takes a share of the change of each component of the velocity against it, to rest at most.
template <int D>
void damp(double fraction, NodeMotion<D>& motion) {
    Components<D> left;
    for (std::size_t a = 0; a < D; ++a) {
        const double before = motion.velocity[a] - motion.velocity_change[a];
        const double speed = std::abs(motion.velocity[a]);
        const double lost = before == 0 ? 0 : fraction * std::abs(motion.velocity_change[a]);
        left[a] = speed > lost ? 1 - lost / speed : 0;
    }
    correct<D>(motion, [&](Components<D> velocity) {
        for (std::size_t a = 0; a < D; ++a) velocity[a] *= left[a];
        return velocity;
    });
}

template <int D>
void build(const EffectBuilder<D>& builder) {
    const double fraction = builder.values.number("fraction");
    const double until = builder.values.number("until");
    // After walls and planes: what they give balances. They hold again what it leaves.
    builder.stages.moved.push_back(
        {"local_damping",
         [=, holds = builder.stages.moved](GridPatch<D>& patch, const StepTime& step) {
             if (step.time >= until) return;
             for (NodeMotion<D>& motion : patch.motion) damp<D>(fraction, motion);
             for (const auto& hold : holds) hold.kernel(patch, step);
         }});
}

}  // namespace

/// A share of each unbalanced force acts against the motion until a time (Cundall 1987), as far as
/// it stops it. The force is that which stress, weight, walls and planes leave together. Where they
/// balance it holds nothing back, so points soon rest under their weight.
EffectKind local_damping_effect() {
    return {"local_damping",
            {within("fraction", "", 0, 0.99), not_negative("until", "s")},
            build<2>,
            build<3>};
}

}  // namespace mpm
