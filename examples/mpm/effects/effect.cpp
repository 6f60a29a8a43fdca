#include "effects/effect.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace mpm {

#define MPM_EFFECT(name) EffectKind name##_effect();
#include "effects/effects.inc"
#undef MPM_EFFECT

namespace {

std::size_t number_of(const std::string& name) {
    std::vector<std::string> names;
    for (const EffectKind& kind : effect_kinds()) {
        if (kind.name == name) return names.size();
        names.push_back(kind.name);
    }
    throw std::invalid_argument("effects: there is no effect '" + name +
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

std::vector<std::optional<Values>> effect_values(const Scene& scene) {
    std::vector<std::optional<Values>> values(effect_kinds().size());
    for (const Effect& effect : scene.effects) {
        const std::size_t kind = number_of(effect.name);
        const std::string place = "effects / " + effect.name;
        if (values[kind]) throw std::invalid_argument(place + " is named twice");
        values[kind].emplace(effect.parameters, effect_kinds()[kind].rules, place, scene.dimension);
    }
    return values;
}

}  // namespace mpm
