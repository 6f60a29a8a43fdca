#include "materials/elastic.hpp"
#include "materials/undrained.hpp"

#include <optional>

namespace mpm {

namespace {

/// The columns that the return mapping reads and changes.
template <int D>
struct Columns {
    StressColumns<D> stress;
    Column start_level;
    std::optional<Column> plastic_strain;  ///< present if the clay softens, or if the scene
                                           ///< requests it
};

/// Returns the kernel of the return mapping. There is one without softening, so that a clay without
/// it does not pay for it.
template <int D, bool softens>
PointKernel<D> return_kernel(const UndrainedStrength& clay, double shear_modulus,
                             const Columns<D>& columns) {
    return [=](Particles& particles, const PointBlock<D>& block) {
        const StressPointers<D> stresses = stress_pointers<D>(particles, columns.stress);
        const double* const level = particles.data(columns.start_level);
        double* const plastic = softens ? particles.data(columns.plastic_strain.value()) : nullptr;
        for (std::size_t p = block.begin; p < block.end; ++p) {
            double strength = clay.intact(level[p]);
            const Stress<D> trial = load<D>(stresses, p);
            if constexpr (softens) {
                strength *= clay.softened(plastic[p]);
                const double tau = std::sqrt(second_invariant(deviator(trial, mean(trial))));
                plastic[p] += std::max(tau - strength, 0.0) / shear_modulus;
            }
            store<D>(returned<D>(strength, trial), stresses, p);
        }
    };
}

template <int D>
MaterialModel<D> build(const Values& values, Particles& particles) {
    MaterialModel<D> model = elastic_model<D>(values, particles);
    Columns<D> columns{
        add_stress_columns<D>(particles), particles.add_column(start_level_column), {}};
    if (values.has("residual_ratio") || values.word("plastic_strain") == "kept")
        columns.plastic_strain = particles.add_column("plastic_strain");
    const auto make = columns.plastic_strain ? return_kernel<D, true> : return_kernel<D, false>;
    model.kernels.push_back(
        {"von_mises", make(undrained_of(values), elastic_of(values).shear_modulus(), columns)});
    return model;
}

}  // namespace

MaterialKind von_mises_material() {
    return {
        "von_mises",
        elastic_rules(
            {not_negative("strength", "Pa"), not_negative("strength_gradient", "Pa/m", 0.0),
             number("surface", "m", 0.0), optional(within("residual_ratio", "", 0, 1)),
             positive("softening_strain", "", 1.0), choice("plastic_strain", {"none", "kept"})}),
        elastic_wave_speed, build<2>, build<3>};
}

}  // namespace mpm
