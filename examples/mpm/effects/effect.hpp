#pragma once

#include "effects/stages.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mpm {

/// Means of an effect to put itself into the step.
template <int D>
struct EffectBuilder {
    const Scene& scene;
    const Values& values;  ///< its parameters, checked
    Particles& particles;  ///< to add columns to
    Stages<D>& stages;     ///< to add kernels to
};

/// An effect: one file in effects/, named in effects.inc.
struct EffectKind {
    std::string name;
    std::vector<Rule> rules;  ///< of its parameters
    void (*build_2)(const EffectBuilder<2>&);
    void (*build_3)(const EffectBuilder<3>&);
};

/// Effects there are, in the order they enter a stage; see effects.inc.
std::span<const EffectKind> effect_kinds();

/// Checked parameters of each effect of a scene, by the number of its kind.
///
/// Throws std::invalid_argument for one that is not known, named twice, or has wrong parameters.
std::vector<std::optional<Values>> effect_values(const Scene& scene);

}  // namespace mpm
