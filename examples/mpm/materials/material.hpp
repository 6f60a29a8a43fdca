#pragma once

#include "transfer/transfers.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace mpm {

/// Kernels and energy of a material.
template <int D>
struct MaterialModel {
    /// Where there are several, the first strains elastically, and those after it return what
    /// stress is too much.
    std::vector<Named<PointKernel<D>>> kernels;
    /// Elastic energy stored in a point, J; per metre of depth in two dimensions.
    std::function<double(const Particles&, std::size_t point)> strain_energy;
};

/// A model of materials: one file in materials/, named in materials.inc.
struct MaterialKind {
    std::string name;
    std::vector<Rule> rules;              ///< of its parameters, `density` among them
    double (*wave_speed)(const Values&);  ///< of pressure waves, m/s
    /// Make the kernels and add the columns they need.
    MaterialModel<2> (*build_2)(const Values&, Particles&);
    MaterialModel<3> (*build_3)(const Values&, Particles&);
};

/// Models there are; see materials.inc.
std::span<const MaterialKind> material_kinds();

/// Model of a material. Throws std::invalid_argument that lists the models for an unknown one.
const MaterialKind& find_material_kind(const Material& material);

/// Checked parameters of a material. Throws std::invalid_argument for wrong ones.
Values values_of(const Material& material, int dimension);

/// Density of a material, kg/m^3.
inline double density_of(const Material& material, int dimension) {
    return values_of(material, dimension).number("density");
}

/// Density that all materials have. Throws std::invalid_argument that names the effect if they
/// differ.
double only_density(const Scene& scene, const std::string& effect);

/// Number of a body's material in the scene. Throws std::invalid_argument where it has no such one.
std::size_t material_of(const Scene& scene, const Body& body);

template <int D>
MaterialModel<D> build_material(const Material& material, Particles& particles) {
    const Values values = values_of(material, D);
    if constexpr (D == 2)
        return find_material_kind(material).build_2(values, particles);
    else
        return find_material_kind(material).build_3(values, particles);
}

}  // namespace mpm
