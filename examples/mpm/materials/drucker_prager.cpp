#include "materials/drucker_prager.hpp"

#include "particles/vectors.hpp"

#include <algorithm>
#include <numbers>

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

/// Kernel that bounds the volume of points parted by tension.
///
/// The force of a point is its stress times its volume. Points that meet again would be too stiff,
/// had their volume grown without end.
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
    const DruckerPrager cone =
        matched_cone(values.number("cohesion"), values.number("friction_angle"),
                     values.number("tension_cut_off"));
    model.kernels.push_back({"drucker_prager", [cone, columns = add_stress_columns<D>(particles)](
                                                   Particles& points, const PointBlock<D>& block) {
                                 return_to<D>(cone, stress_pointers<D>(points, columns),
                                              block.begin, block.end);
                             }});
    if (values.has("most_expansion")) {
        const double largest = values.number("most_expansion") / values.number("density");
        model.kernels.push_back(
            {"volume_limit", limit_kernel<D>(largest, particles.add_column("mass"),
                                             particles.add_column("volume"))});
    }
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
                       optional(within("most_expansion", "", 1, 1e6))}),
        elastic_wave_speed, build<2>, build<3>};
}

}  // namespace mpm
