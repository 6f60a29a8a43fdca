#pragma once

#include "effects/stages.hpp"

#include <span>
#include <string>
#include <vector>

namespace mpm {

/// The scene, points and stages that the function that builds an effect receives.
template <int D>
struct EffectBuilder {
    const Scene& scene;
    const Values& values;  ///< checked parameters of the effect
    Particles& particles;  ///< to add columns to
    Stages<D>& stages;     ///< to add kernels to
    double wave_speed;     ///< largest wave speed of the scene's materials, m/s
};

/// An effect: one file in effects/ or paper/, named in effects.inc.
struct EffectKind {
    std::string name;
    std::vector<Rule> rules;  ///< of its parameters
    void (*build_2)(const EffectBuilder<2>&);
    void (*build_3)(const EffectBuilder<3>&);
};

/// An effect that a scene names, with its checked parameters.
struct NamedEffect {
    const EffectKind* kind;
    Values values;
};

/// Returns all effects, in the order in which they are added to a stage; see effects.inc.
std::span<const EffectKind> effect_kinds();

/// Returns the effects of a scene in the order of effect_kinds(). Throws std::invalid_argument for
/// an unknown effect, one that is named twice, and wrong parameters.
std::vector<NamedEffect> effects_of(const Scene& scene);

}  // namespace mpm
