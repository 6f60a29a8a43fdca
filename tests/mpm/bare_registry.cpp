// The registry of a library that has nothing beside what the slope names.

#include <mpm/effect.hpp>
#include <mpm/material.hpp>

namespace mpm {

MaterialKind drucker_prager_material();
EffectKind gravity_effect();

std::span<const MaterialKind> material_kinds() {
    static const std::vector<MaterialKind> kinds{drucker_prager_material()};
    return kinds;
}

std::span<const EffectKind> effect_kinds() {
    static const std::vector<EffectKind> kinds{gravity_effect()};
    return kinds;
}

}  // namespace mpm
