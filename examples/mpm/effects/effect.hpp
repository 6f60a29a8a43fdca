#pragma once

#include "effects/stages.hpp"

#include <span>
#include <string>
#include <vector>

namespace mpm {

/// Scene, points and stages, handed to an effect that is built.
template <int D>
struct EffectBuilder {
    const Scene& scene;
    const Values& values;  ///< its parameters, checked
    Particles& particles;  ///< to add columns to
    Stages<D>& stages;     ///< to add kernels to
    double wave_speed;     ///< the largest of its materials, m/s
};

/// An effect: one file in effects/, named in effects.inc.
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

/// Effects there are, in the order they enter a stage; see effects.inc.
std::span<const EffectKind> effect_kinds();

/// Effects of a scene in the order of their kinds. Throws std::invalid_argument for an unknown
/// effect, one named twice, and wrong parameters.
std::vector<NamedEffect> effects_of(const Scene& scene);

}  // namespace mpm
