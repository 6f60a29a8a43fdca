#pragma once

#include "effects/effect.hpp"
#include "materials/undrained.hpp"

namespace mpm {

/// The undrained strength of points, whatever their material.
template <int D>
class SoilStrength {
  public:
    /// Throws std::invalid_argument where a material of the scene has none; `asked_by` needs it.
    SoilStrength(const EffectBuilder<D>& builder, const std::string& asked_by);

    /// Strength at the depth, softening and rate of point `p` of the block, Pa.
    double at(const Particles& particles, const PointBlock<D>& block, std::size_t p) const;

  private:
    std::vector<UndrainedStrength> clays_;  ///< by material
    Column y_, displacement_y_;
    std::optional<Column> material_, plastic_strain_;
};

}  // namespace mpm
