#include "materials/elastic.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

/// Stress after a step from an elastic trial stress, whose mean stays. The viscosity is implicit,
/// so it does not limit the time step. `stiffness` is shear modulus * time step.
template <int D>
Stress<D> returned(double yield_stress, double viscosity, double stiffness,
                   const Stress<D>& trial) {
    const double pressure = mean(trial);
    const Stress<D> shear = deviator(trial, pressure);
    const double tau = std::sqrt(second_invariant(shear));
    if (!(tau > yield_stress)) return trial;
    const double rate = (tau - yield_stress) / (stiffness + viscosity);
    return composed(pressure, std::max(1 - stiffness * rate / tau, 0.0), shear);
}

template <int D>
MaterialModel<D> build(const Values& values, Particles& particles) {
    MaterialModel<D> model = elastic_model<D>(values, particles);
    const auto kernel = [yield_stress = values.number("yield_stress"),
                         viscosity = values.number("viscosity"),
                         shear_modulus = elastic_of(values).shear_modulus(),
                         columns = add_stress_columns<D>(particles)](Particles& points,
                                                                     const PointBlock<D>& block) {
        const StressPointers<D> stresses = stress_pointers<D>(points, columns);
        const double stiffness = shear_modulus * block.time_step;
        for (std::size_t p = block.begin; p < block.end; ++p)
            store<D>(returned<D>(yield_stress, viscosity, stiffness, load<D>(stresses, p)),
                     stresses, p);
    };
    model.kernels.push_back({"bingham", kernel});
    return model;
}

}  // namespace

/// A fluid, elastic below its yield stress: shear stress yield_stress + viscosity * rate.
MaterialKind bingham_material() {
    return {
        "bingham",
        elastic_rules({not_negative("yield_stress", "Pa", 0.0), not_negative("viscosity", "Pa s")}),
        elastic_wave_speed, build<2>, build<3>};
}

}  // namespace mpm
