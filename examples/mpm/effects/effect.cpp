#include "effects/effect.hpp"

#include <algorithm>
#include <stdexcept>

namespace mpm {

#define MPM_EFFECT(name) EffectKind name##_effect();
#include "effects/effects.inc"
#undef MPM_EFFECT

namespace {

const EffectKind& kind_of(const Effect& effect) {
    std::vector<std::string> names;
    for (const EffectKind& kind : effect_kinds()) {
        if (kind.name == effect.name) return kind;
        names.push_back(kind.name);
    }
    throw std::invalid_argument("effects: there is no effect '" + effect.name +
                                "'; possible: " + joined(names));
}

}  // namespace

std::span<const EffectKind> effect_kinds() {
#define MPM_EFFECT(name) name##_effect(),
    static const std::vector<EffectKind> kinds{
#include "effects/effects.inc"
    };
#undef MPM_EFFECT
    return kinds;
}

std::vector<NamedEffect> effects_of(const Scene& scene) {
    std::vector<NamedEffect> effects;
    for (const Effect& effect : scene.effects) {
        const EffectKind& kind = kind_of(effect);
        const std::string place = "effects / " + effect.name;
        if (std::ranges::find(effects, &kind, &NamedEffect::kind) != effects.end())
            throw std::invalid_argument(place + " is named twice");
        effects.push_back({&kind, Values(effect.parameters, kind.rules, place, scene.dimension)});
    }
    std::ranges::sort(effects, {}, &NamedEffect::kind);
    return effects;
}

}  // namespace mpm
