#include "effects/effect.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace mpm {

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

template <int D>
Stages<D> build_stages(const Scene& scene, Particles& particles) {
    Stages<D> stages;
    add_walls<D>(scene, stages);
    add_planes<D>(scene, stages);
    const std::vector<std::optional<Values>> values = effect_values(scene);
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (!values[k]) continue;
        const EffectBuilder<D> builder{scene, *values[k], particles, stages};
        if constexpr (D == 2)
            effect_kinds()[k].build_2(builder);
        else
            effect_kinds()[k].build_3(builder);
    }
    add_images<D>(scene, stages);
    return stages;
}

template Stages<2> build_stages<2>(const Scene&, Particles&);
template Stages<3> build_stages<3>(const Scene&, Particles&);

}  // namespace mpm
