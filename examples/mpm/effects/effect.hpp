#pragma once

#include "effects/stages.hpp"

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace mpm {

/// Scene, points and stages, handed to an effect that is built.
template <int D>
struct EffectBuilder {
    const Scene& scene;
    const std::string& name;  ///< its own in the scene
    const Values& values;     ///< its parameters, checked
    Particles& particles;     ///< to add columns to
    Stages<D>& stages;        ///< to add kernels to
    double wave_speed;        ///< the largest of its materials, m/s

    /// Adds a column named after the effect. Throws std::invalid_argument where another has it.
    Column add_own_column(const std::string& ending) const {
        if (particles.has_column(name + ending))
            throw std::invalid_argument("effects / " + name + ": the points have a column '" +
                                        name + ending + "' already; give the effect another name");
        return particles.add_column(name + ending);
    }
};

/// An effect: one file in effects/, named in effects.inc.
struct EffectKind {
    std::string name;
    std::vector<Rule> rules;  ///< of its parameters
    void (*build_2)(const EffectBuilder<2>&);
    void (*build_3)(const EffectBuilder<3>&);
    bool may_repeat = false;  ///< whether a scene may have several
};

/// An effect that a scene names, with its checked parameters.
struct NamedEffect {
    const EffectKind* kind;
    std::string name;
    Values values;
};

/// Effects there are, in the order they enter a stage; see effects.inc.
std::span<const EffectKind> effect_kinds();

/// Effects of a scene in the order of their kinds, those of one kind in the order of the scene.
///
/// Throws std::invalid_argument for an unknown effect, one named twice or by other characters than
/// letters, digits, _ and -, a second one of a kind that may not repeat, and wrong parameters.
std::vector<NamedEffect> effects_of(const Scene& scene);

}  // namespace mpm
