#pragma once

#include "transfer/transfers.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace mpm {

/// The kernels and the elastic energy of a material.
template <int D>
struct MaterialModel {
    /// The first kernel computes the elastic trial stress. The others return it to an admissible
    /// stress.
    std::vector<Named<PointKernel<D>>> kernels;
    /// Returns the elastic energy stored in a point, J; per metre of depth in two dimensions.
    std::function<double(const Particles&, std::size_t point)> strain_energy;
};

/// A material model. Each has one file in materials/ and one line in materials.inc.
struct MaterialKind {
    std::string name;
    std::vector<Rule> rules;              ///< rules of its parameters, including `density`
    double (*wave_speed)(const Values&);  ///< of pressure waves, m/s
    /// Create the kernels and add the columns that they need.
    MaterialModel<2> (*build_2)(const Values&, Particles&);
    MaterialModel<3> (*build_3)(const Values&, Particles&);
};

/// Returns all material models; see materials.inc.
std::span<const MaterialKind> material_kinds();

/// Returns the model of a material. Throws std::invalid_argument with a list of all models if it is
/// unknown.
const MaterialKind& find_material_kind(const Material& material);

/// Returns the checked parameters of a material. Throws std::invalid_argument if they are wrong.
Values values_of(const Material& material, int dimension);

/// Returns the density of a material, kg/m^3.
inline double density_of(const Material& material, int dimension) {
    return values_of(material, dimension).number("density");
}

/// Returns the density that all materials have. If they differ, throws std::invalid_argument with
/// the name of the effect.
double only_density(const Scene& scene, const std::string& effect);

/// Returns the index in the scene of a body's material. Throws std::invalid_argument if the scene
/// does not contain it.
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
