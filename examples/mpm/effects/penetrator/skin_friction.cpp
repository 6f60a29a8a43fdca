#include "effects/penetrator/skin_friction.hpp"

#include "materials/material.hpp"
#include "materials/undrained.hpp"

#include <optional>
#include <stdexcept>

namespace mpm {

namespace {

/// The undrained strength of points, whatever their material.
template <int D>
class SoilStrength {
  public:
    /// Throws std::invalid_argument where a material of the scene has none.
    explicit SoilStrength(const EffectBuilder<D>& builder)
        : start_level_(builder.particles.add_column(start_level_column)) {
        for (const Material& material : builder.scene.materials) {
            if (material.model != "von_mises")
                throw std::invalid_argument(
                    "effects / penetrator: 'adhesion_factor' needs an undrained strength; the "
                    "material '" +
                    material.name + "' must be von_mises, not " + material.model);
            clays_.push_back(undrained_of(values_of(material, D)));
        }
        if (clays_.size() > 1) material_ = builder.particles.find_column("material");
        if (builder.particles.has_column("plastic_strain"))
            plastic_strain_ = builder.particles.find_column("plastic_strain");
    }

    /// Strength at the depth, softening and rate of point `p` of the block, Pa.
    double at(const Particles& particles, const PointBlock<D>& block, std::size_t p) const {
        const std::size_t number =
            material_ ? static_cast<std::size_t>(particles[*material_][p]) : 0;
        const UndrainedStrength& clay = clays_[number];
        double strength = clay.intact(particles[start_level_][p]);
        if (plastic_strain_) strength *= clay.softened(particles[*plastic_strain_][p]);
        if (clay.rate_factor > 0) strength *= clay.quickened(shear_rate<D>(block, p - block.begin));
        return strength;
    }

  private:
    std::vector<UndrainedStrength> clays_;  ///< by material
    Column start_level_;
    std::optional<Column> material_, plastic_strain_;
};

}  // namespace

template <int D>
SkinFriction<D> skin_friction(const EffectBuilder<D>& builder) {
    const Values& values = builder.values;
    SkinFriction<D> skin{.coefficient = values.number("friction")};
    if (values.has("adhesion") && values.has("adhesion_factor"))
        throw std::invalid_argument(
            "effects / penetrator: give 'adhesion' or 'adhesion_factor', not both");
    if (values.has("adhesion"))
        skin.limit = [most = values.number("adhesion")](const Particles&, const PointBlock<D>&,
                                                        std::size_t) { return most; };
    if (values.has("adhesion_factor"))
        skin.limit = [factor = values.number("adhesion_factor"),
                      strength = SoilStrength<D>(builder)](
                         const Particles& particles, const PointBlock<D>& block, std::size_t p) {
            return factor * strength.at(particles, block, p);
        };
    return skin;
}

std::vector<Rule> skin_friction_rules() {
    return {not_negative("friction", "", 0.0), optional(not_negative("adhesion", "Pa")),
            optional(not_negative("adhesion_factor", ""))};
}

template SkinFriction<2> skin_friction(const EffectBuilder<2>&);
template SkinFriction<3> skin_friction(const EffectBuilder<3>&);

}  // namespace mpm
