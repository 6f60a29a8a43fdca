#include "materials/drucker_prager.hpp"

#include "particles/vectors.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

namespace mpm {

namespace {

template <int D>
MPM_VECTOR_CLONES void return_to(const DruckerPrager& cone, const StressPointers<D>& stresses,
                                 std::size_t begin, std::size_t end) {
    const StressPointers<D> columns = stresses;
    const DruckerPrager admissible = cone;
#pragma GCC ivdep
    for (std::size_t p = begin; p < end; ++p)
        store<D>(returned<D>(admissible, load<D>(columns, p)), columns, p);
}

/// The columns that the return mapping reads and changes.
template <int D>
struct Columns {
    explicit Columns(Particles& particles)
        : stress(add_stress_columns<D>(particles)),
          mass(particles.add_column("mass")),
          volume(particles.add_column("volume")) {}
    StressColumns<D> stress;
    Column mass, volume;
    std::optional<Column> plastic_strain = {};  ///< present if the scene requests it
};

/// Adds the plastic shear strain of the return mapping that follows.
template <int D>
void add_plastic_strain(const DruckerPrager& cone, double shear_modulus,
                        const StressPointers<D>& stresses, double* plastic,
                        const PointBlock<D>& block) {
    for (std::size_t p = block.begin; p < block.end; ++p) {
        const Stress<D> trial = load<D>(stresses, p), after = returned<D>(cone, trial);
        const auto tau = [](const Stress<D>& stress) {
            return std::sqrt(second_invariant(deviator(stress, mean(stress))));
        };
        plastic[p] += (tau(trial) - tau(after)) / shear_modulus;
    }
}

/// Bounds the volume of points that tension has separated.
///
/// The force of a point is its stress times its volume. Without the bound the volume of separated
/// points grows without limit, and they are too stiff when they meet again.
void limit_volumes(double largest_by_mass, const double* masses, double* volumes, std::size_t begin,
                   std::size_t end) {
#pragma GCC ivdep
    for (std::size_t p = begin; p < end; ++p)
        volumes[p] = std::min(volumes[p], largest_by_mass * masses[p]);
}

template <int D>
MaterialModel<D> build(const Values& values, Particles& particles) {
    MaterialModel<D> model = elastic_model<D>(values, particles);
    const DruckerPrager cone =
        matched_cone(values.number("cohesion"), values.number("friction_angle"),
                     values.number("tension_cut_off"));
    Columns<D> columns(particles);
    if (values.word("plastic_strain") == "kept")
        columns.plastic_strain = particles.add_column("plastic_strain");
    const auto kernel = [cone, columns, shear_modulus = elastic_of(values).shear_modulus(),
                         largest = values.number("most_expansion") / values.number("density")](
                            Particles& points, const PointBlock<D>& block) {
        const StressPointers<D> stresses = stress_pointers<D>(points, columns.stress);
        if (columns.plastic_strain)
            add_plastic_strain<D>(cone, shear_modulus, stresses,
                                  points.data(*columns.plastic_strain), block);
        return_to<D>(cone, stresses, block.begin, block.end);
        limit_volumes(largest, points.data(columns.mass), points.data(columns.volume), block.begin,
                      block.end);
    };
    model.kernels.push_back({"drucker_prager", kernel});
    return model;
}

}  // namespace

DruckerPrager matched_cone(double cohesion, double friction_angle, double tension_cut_off) {
    const double angle = friction_angle * std::numbers::pi / 180;
    DruckerPrager cone{std::sin(angle), cohesion * std::cos(angle), tension_cut_off};
    if (cone.friction > 0) cone.tension = std::min(cone.tension, cone.cohesion / cone.friction);
    return cone;
}

MaterialKind drucker_prager_material() {
    return {
        "drucker_prager",
        elastic_rules({not_negative("cohesion", "Pa"), within("friction_angle", "degrees", 0, 89),
                       not_negative("tension_cut_off", "Pa", 0.0),
                       within("most_expansion", "", 1, 1e6, 1.5),
                       choice("plastic_strain", {"none", "kept"})}),
        elastic_wave_speed, build<2>, build<3>};
}

}  // namespace mpm
