#include <mpm/effect.hpp>

namespace mpm {

namespace {

template <int D>
void build(const EffectBuilder<D>& builder) {
    Components<D> acceleration{};
    std::copy_n(builder.values.list("acceleration").begin(), D, acceleration.begin());
    const double ramp = builder.values.number("ramp");
    builder.stages.forces.push_back({"gravity", [=](GridPatch<D>& patch, const StepTime& step) {
                                         const double share =
                                             step.time < ramp ? step.time / ramp : 1;
                                         Components<D> pull = acceleration;
                                         for (double& component : pull) component *= share;
                                         for (Node<D>& node : patch.sums)
                                             for (std::size_t a = 0; a < D; ++a)
                                                 node.force[a] += node.mass * pull[a];
                                     }});
}

}  // namespace

EffectKind gravity_effect() {
    return {"gravity",
            {vector("acceleration", "m/s^2"), not_negative("ramp", "s", 0.0)},
            build<2>,
            build<3>};
}

}  // namespace mpm
