#include "../vector_clones.hpp"

#include <mpm/drucker_prager.hpp>

#include <algorithm>
#include <numbers>

namespace mpm {

namespace {

DruckerPrager cone_of(double friction, double cohesion, double tension) {
    DruckerPrager cone{friction, cohesion, tension};
    if (friction > 0) cone.tension = std::min(tension, cohesion / friction);
    return cone;
}

template <int D>
MPM_VECTOR_CLONES void return_to(const DruckerPrager& cone, const StressPointers<D>& stresses,
                                 std::size_t begin, std::size_t end) {
    const StressPointers<D> columns = stresses;
    const DruckerPrager admissible = cone;
#pragma GCC ivdep
    for (std::size_t p = begin; p < end; ++p)
        store<D>(returned<D>(admissible, load<D>(columns, p)), columns, p);
}

template <int D>
PointKernel<D> return_kernel(const DruckerPrager& cone, const StressColumns<D>& columns) {
    return [cone, columns](Particles& particles, const PointBlock<D>& block) {
        return_to<D>(cone, stress_pointers<D>(particles, columns), block.begin, block.end);
    };
}

/// Keeps the volume of points that tension has parted from growing without end: it is what gives
/// them stiffness when they meet again.
template <int D>
PointKernel<D> limit_kernel(double largest_by_mass, Column mass, Column volume) {
    return [=](Particles& particles, const PointBlock<D>& block) {
        const double* const masses = particles.data(mass);
        double* const volumes = particles.data(volume);
        for (std::size_t p = block.begin; p < block.end; ++p)
            volumes[p] = std::min(volumes[p], largest_by_mass * masses[p]);
    };
}

template <int D>
MaterialModel<D> build(const Values& values, Particles& particles) {
    MaterialModel<D> model = elastic_model<D>(values, particles);
    const MohrCoulomb strength{values.number("cohesion"), values.number("friction_angle"),
                               values.number("tension_cut_off")};
    const DruckerPrager cone =
        values.word("match") == "inner" ? inner_cone(strength) : matched_cone(strength);
    model.kernels.push_back(
        {"drucker_prager", return_kernel<D>(cone, add_stress_columns<D>(particles))});
    if (values.has("most_expansion")) {
        const double largest = values.number("most_expansion") / values.number("density");
        model.kernels.push_back(
            {"volume_limit", limit_kernel<D>(largest, particles.add_column("mass"),
                                             particles.add_column("volume"))});
    }
    return model;
}

std::vector<Rule> rules() {
    Rule angle = within("friction_angle", "degrees", 0, 89);
    return elastic_rules({not_negative("cohesion", "Pa"), angle,
                          not_negative("tension_cut_off", "Pa", 0.0),
                          choice("match", {"plane_strain", "inner"}),
                          optional(within("most_expansion", "", 1, 1e6))});
}

}  // namespace

DruckerPrager matched_cone(const MohrCoulomb& strength) {
    const double angle = strength.friction_angle * std::numbers::pi / 180;
    return cone_of(std::sin(angle), strength.cohesion * std::cos(angle), strength.tension_cut_off);
}

DruckerPrager inner_cone(const MohrCoulomb& strength) {
    const double angle = strength.friction_angle * std::numbers::pi / 180;
    const double factor = 6 / (std::numbers::sqrt3 * (3 + std::sin(angle)));
    return cone_of(factor * std::sin(angle), factor * strength.cohesion * std::cos(angle),
                   strength.tension_cut_off);
}

MaterialKind drucker_prager_material() {
    return {"drucker_prager", rules(), elastic_wave_speed, build<2>, build<3>};
}

}  // namespace mpm
