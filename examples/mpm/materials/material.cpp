#include "materials/material.hpp"

#include <stdexcept>

namespace mpm {

#define MPM_MATERIAL(name) MaterialKind name##_material();
#include "materials/materials.inc"
#undef MPM_MATERIAL

namespace {

std::string place_of(const Material& material) {
    return "materials / " + material.name;
}

}  // namespace

std::span<const MaterialKind> material_kinds() {
#define MPM_MATERIAL(name) name##_material(),
    static const std::vector<MaterialKind> kinds{
#include "materials/materials.inc"
    };
#undef MPM_MATERIAL
    return kinds;
}

const MaterialKind& find_material_kind(const Material& material) {
    std::vector<std::string> names;
    for (const MaterialKind& kind : material_kinds()) {
        if (kind.name == material.model) return kind;
        names.push_back(kind.name);
    }
    throw std::invalid_argument(place_of(material) + ": there is no model '" + material.model +
                                "'; possible: " + joined(names));
}

Values values_of(const Material& material, int dimension) {
    return {material.parameters, find_material_kind(material).rules, place_of(material), dimension};
}

double only_density(const Scene& scene, const std::string& effect) {
    const double density = density_of(scene.materials.front(), scene.dimension);
    for (const Material& material : scene.materials)
        if (density_of(material, scene.dimension) != density)
            throw std::invalid_argument("effects / " + effect +
                                        ": all materials must have the same density");
    return density;
}

std::size_t material_of(const Scene& scene, const Body& body) {
    std::vector<std::string> names;
    for (const Material& material : scene.materials) {
        if (material.name == body.material) return names.size();
        names.push_back(material.name);
    }
    throw std::invalid_argument("bodies: there is no material '" + body.material +
                                "'; possible: " + joined(names));
}

}  // namespace mpm
