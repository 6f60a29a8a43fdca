#pragma once

#include "effects/stages.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mpm {

/// What an effect has at hand to put itself into the step.
template <int D>
struct EffectBuilder {
    const Scene& scene;
    const Values& values;  ///< its parameters, checked
    Particles& particles;  ///< to add columns to
    Stages<D>& stages;     ///< to add kernels to
};

/// An effect: one file in src/effects, named in CMakeLists.txt.
struct EffectKind {
    std::string name;
    std::vector<Rule> rules;  ///< of its parameters
    void (*build_2)(const EffectBuilder<2>&);
    void (*build_3)(const EffectBuilder<3>&);
};

/// All effects there are, in the order they enter a stage.
std::span<const EffectKind> effect_kinds();

/// The parameters of each effect of a scene, checked, by the number of its kind.
///
/// Throws std::invalid_argument for one that is not known, named twice, or has wrong parameters.
std::vector<std::optional<Values>> effect_values(const Scene& scene);

/// The stages of a scene: its effects, its planes, and its walls unless all are open.
template <int D>
Stages<D> build_stages(const Scene& scene, Particles& particles);

/// Holds the nodes on the sides of the domain: `walls` before they move, and `friction` after;
/// neither where all sides are open.
///
/// Where shape functions reach beyond a roller or fixed wall, what points hand to nodes there goes
/// to their mirror images inside, with the signs that leave the wall at rest.
template <int D>
void add_walls(const Scene& scene, Stages<D>& stages);

/// Holds the nodes with mass on the planes and behind them, after they have moved; nothing where
/// there is no plane. What walls hold stays held.
template <int D>
void add_planes(const Scene& scene, Stages<D>& stages);

/// Lets nodes beyond walls move as their mirror images; comes after all that changes those.
template <int D>
void add_images(const Scene& scene, Stages<D>& stages);

}  // namespace mpm
