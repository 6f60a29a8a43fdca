#include "effects/penetrator/soil_strength.hpp"

#include "materials/material.hpp"

#include <stdexcept>

namespace mpm {

template <int D>
SoilStrength<D>::SoilStrength(const EffectBuilder<D>& builder, const std::string& asked_by)
    : y_(builder.particles.add_column("y")),
      displacement_y_(builder.particles.add_column("displacement_y")) {
    for (const Material& material : builder.scene.materials) {
        if (material.model != "von_mises")
            throw std::invalid_argument(asked_by + " needs an undrained strength; the material '" +
                                        material.name + "' must be von_mises, not " +
                                        material.model);
        clays_.push_back(undrained_of(values_of(material, D)));
    }
    if (clays_.size() > 1) material_ = builder.particles.find_column("material");
    if (builder.particles.has_column("plastic_strain"))
        plastic_strain_ = builder.particles.find_column("plastic_strain");
}

template <int D>
double SoilStrength<D>::at(const Particles& particles, const PointBlock<D>& block,
                           std::size_t p) const {
    const std::size_t number = material_ ? static_cast<std::size_t>(particles[*material_][p]) : 0;
    const UndrainedStrength& clay = clays_[number];
    double strength = clay.intact(particles[y_][p] - particles[displacement_y_][p]);
    if (plastic_strain_) strength *= clay.softened(particles[*plastic_strain_][p]);
    if (clay.rate_factor > 0) strength *= clay.quickened(shear_rate<D>(block, p - block.begin));
    return strength;
}

template class SoilStrength<2>;
template class SoilStrength<3>;

}  // namespace mpm
