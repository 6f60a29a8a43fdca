#include "effects/effect.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace mpm {

#define MPM_EFFECT(name) EffectKind name##_effect();
#include "effects/effects.inc"
#undef MPM_EFFECT

namespace {

const EffectKind& kind_of(const Effect& effect) {
    const std::string& name = effect.kind.empty() ? effect.name : effect.kind;
    std::vector<std::string> names;
    for (const EffectKind& kind : effect_kinds()) {
        if (kind.name == name) return kind;
        names.push_back(kind.name);
    }
    throw std::invalid_argument("effects: there is no effect '" + name + "'; possible: " +
                                joined(names) + "; another name needs one of these as its 'kind'");
}

/// Throws std::invalid_argument where a name would not do in the files that tell columns by it.
void check_name(const std::string& name) {
    const auto may_stand = [](unsigned char character) {
        return std::isalnum(character) != 0 || character == '_' || character == '-';
    };
    if (name.empty() || !std::ranges::all_of(name, may_stand))
        throw std::invalid_argument("effects / " + name +
                                    ": the name must be of letters, digits, _ and -");
}

/// Throws std::invalid_argument where an effect may not stand beside one before it.
void check_beside(const NamedEffect& effect, const std::vector<NamedEffect>& before) {
    const std::string place = "effects / " + effect.name;
    for (const NamedEffect& other : before) {
        if (other.name == effect.name) throw std::invalid_argument(place + " is named twice");
        if (other.kind == effect.kind && !effect.kind->may_repeat)
            throw std::invalid_argument(place + " is a second " + effect.kind->name + " beside '" +
                                        other.name + "', of which a scene has one");
    }
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
        NamedEffect named{
            &kind, effect.name,
            Values(effect.parameters, kind.rules, "effects / " + effect.name, scene.dimension)};
        check_name(effect.name);
        check_beside(named, effects);
        effects.push_back(std::move(named));
    }
    std::ranges::stable_sort(effects, {}, &NamedEffect::kind);
    return effects;
}

}  // namespace mpm
