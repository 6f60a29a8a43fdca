#include "effects/effect.hpp"
#include "materials/material.hpp"

#include <stdexcept>

namespace mpm {

namespace {

constexpr std::size_t vertical = 1;

template <int D>
void build(const EffectBuilder<D>& builder) {
    if (!builder.stages.gravity)
        throw std::invalid_argument("effects / geostatic: needs the effect gravity");
    if (builder.stages.gravity->ramp > 0)
        throw std::invalid_argument(
            "effects / geostatic: stresses of the full weight are there from the start, so gravity "
            "must be, too; leave out its 'ramp'");
    const double density = only_density(builder.scene, "geostatic");
    const double pull = -builder.stages.gravity->acceleration[vertical];
    const double surface = builder.values.number("surface");
    const double ratio = builder.values.number("lateral_ratio");
    const MotionColumns motion = add_motion_columns(builder.particles, D);
    const StressColumns<D> stress = add_stress_columns<D>(builder.particles);
    builder.stages.preparations.push_back([=](Particles& particles) {
        for (std::size_t p = 0; p < particles.size(); ++p) {
            const double depth = surface - particles[motion.position[vertical]][p];
            const double pressure = density * pull * std::max(depth, 0.0);
            // The first three columns are the stresses along the axes.
            for (std::size_t a = 0; a < 3; ++a)
                particles.data(stress[a])[p] = a == vertical ? -pressure : -ratio * pressure;
        }
    });
}

}  // namespace

/// Starts ground in equilibrium with its weight. The vertical stress is density * gravity * depth
/// below a level surface; the lateral stress is a given share of it. All materials must have one
/// density.
EffectKind geostatic_effect() {
    return {"geostatic",
            {number("surface", "m", 0.0), not_negative("lateral_ratio", "", 1.0)},
            build<2>,
            build<3>};
}

}  // namespace mpm
