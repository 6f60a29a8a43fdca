#include "materials/elastic.hpp"
#include "materials/tresca.hpp"
#include "materials/undrained.hpp"

#include <optional>

namespace mpm {

namespace {

/// Columns that the return reads and changes.
template <int D>
struct Columns {
    StressColumns<D> stress;
    Column start_level;
    std::optional<Column> plastic_strain;  ///< where the clay softens, or the scene asks for it
};

/// Criteria of yield: the shear of a stress that reaches the strength, and the return to it.
struct VonMises {
    static constexpr const char* name = "von_mises";
    template <int D>
    static double shear(const Stress<D>& stress) {
        return std::sqrt(second_invariant(deviator(stress, mean(stress))));
    }
    template <int D>
    static Stress<D> back(double strength, const Stress<D>& trial) {
        return returned<D>(strength, trial);
    }
};

struct Tresca {
    static constexpr const char* name = "tresca";
    template <int D>
    static double shear(const Stress<D>& stress) {
        return largest_shear<D>(stress);
    }
    template <int D>
    static Stress<D> back(double strength, const Stress<D>& trial) {
        return returned_to_tresca<D>(strength, trial);
    }
};

/// Kernel of the return, one for each choice of softening and rate: neither costs a clay without
/// it.
template <int D, class Criterion, bool softens, bool has_rate>
PointKernel<D> return_kernel(const UndrainedStrength& clay, double shear_modulus,
                             const Columns<D>& columns) {
    return [=](Particles& particles, const PointBlock<D>& block) {
        const StressPointers<D> stresses = stress_pointers<D>(particles, columns.stress);
        const double* const level = particles.data(columns.start_level);
        double* const plastic = softens ? particles.data(columns.plastic_strain.value()) : nullptr;
        for (std::size_t p = block.begin; p < block.end; ++p) {
            double strength = clay.intact(level[p]);
            if constexpr (softens) strength *= clay.softened(plastic[p]);
            if constexpr (has_rate)
                strength *= clay.quickened(shear_rate<D>(block, p - block.begin));
            const Stress<D> trial = load<D>(stresses, p);
            if constexpr (softens) {
                const double excess = Criterion::template shear<D>(trial) - strength;
                plastic[p] += std::max(excess, 0.0) / shear_modulus;
            }
            store<D>(Criterion::template back<D>(strength, trial), stresses, p);
        }
    };
}

template <int D, class Criterion>
Named<PointKernel<D>> make_kernel(const Values& values, const Columns<D>& columns) {
    const UndrainedStrength clay = undrained_of(values);
    const double shear = elastic_of(values).shear_modulus();
    const bool has_rate = values.has("rate_factor");
    if (columns.plastic_strain)
        return {Criterion::name,
                has_rate ? return_kernel<D, Criterion, true, true>(clay, shear, columns)
                         : return_kernel<D, Criterion, true, false>(clay, shear, columns)};
    return {Criterion::name, has_rate
                                 ? return_kernel<D, Criterion, false, true>(clay, shear, columns)
                                 : return_kernel<D, Criterion, false, false>(clay, shear, columns)};
}

template <int D>
MaterialModel<D> build(const Values& values, Particles& particles) {
    MaterialModel<D> model = elastic_model<D>(values, particles);
    Columns<D> columns{
        add_stress_columns<D>(particles), particles.add_column(start_level_column), {}};
    if (values.has("residual_ratio") || keeps_plastic_strain(values))
        columns.plastic_strain = particles.add_column("plastic_strain");
    model.kernels.push_back(values.word("criterion") == "tresca"
                                ? make_kernel<D, Tresca>(values, columns)
                                : make_kernel<D, VonMises>(values, columns));
    return model;
}

}  // namespace

MaterialKind von_mises_material() {
    return {"von_mises",
            elastic_rules(
                {not_negative("strength", "Pa"), not_negative("strength_gradient", "Pa/m", 0.0),
                 number("surface", "m", 0.0), optional(within("residual_ratio", "", 0, 1)),
                 positive("softening_strain", "", 1.0), optional(not_negative("rate_factor", "")),
                 positive("reference_rate", "1/s", 1.0),
                 choice("criterion", {"von_mises", "tresca"}), plastic_strain_rule()}),
            elastic_wave_speed, build<2>, build<3>};
}

}  // namespace mpm
