#include "materials/drucker_prager.hpp"

#include "particles/vector_clones.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace mpm {

namespace {

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

double sine_of(double degrees) {
    return std::sin(radians(degrees));
}

DruckerPrager cone_of(const MohrCoulomb& strength, double factor, double dilation) {
    DruckerPrager cone{factor * sine_of(strength.friction_angle),
                       factor * strength.cohesion * std::cos(radians(strength.friction_angle)),
                       strength.tension_cut_off, dilation};
    if (cone.friction > 0) cone.tension = std::min(cone.tension, cone.cohesion / cone.friction);
    return cone;
}

/// Cone through the edges of triaxial extension, `sign` +1, or compression, -1.
DruckerPrager triaxial_cone(const MohrCoulomb& strength, double sign) {
    const auto factor = [sign](double angle) {
        return 6 / (std::numbers::sqrt3 * (3 + sign * sine_of(angle)));
    };
    return cone_of(strength, factor(strength.friction_angle),
                   factor(strength.dilation_angle) * sine_of(strength.dilation_angle));
}

template <int D>
double shear_of(const Stress<D>& stress) {
    return std::sqrt(second_invariant(deviator(stress, mean(stress))));
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

template <int D>
PointKernel<D> dilating_kernel(const DruckerPrager& cone, const Elastic& elastic,
                               const StressColumns<D>& columns) {
    return [cone, columns, bulk = elastic.bulk_modulus(), shear = elastic.shear_modulus()](
               Particles& particles, const PointBlock<D>& block) {
        const StressPointers<D> stresses = stress_pointers<D>(particles, columns);
        for (std::size_t p = block.begin; p < block.end; ++p)
            store<D>(returned<D>(cone, bulk, shear, load<D>(stresses, p)), stresses, p);
    };
}

/// Kernel of a return that adds up the plastic shear strain, 2 sqrt(J2) of its deviator: what the
/// return takes from sqrt(J2) of the stress, by the shear modulus.
template <int D, typename Return>
PointKernel<D> keeping_kernel(Return back, double shear_modulus, const StressColumns<D>& columns,
                              Column plastic_strain) {
    return [=](Particles& particles, const PointBlock<D>& block) {
        const StressPointers<D> stresses = stress_pointers<D>(particles, columns);
        double* const plastic = particles.data(plastic_strain);
        for (std::size_t p = block.begin; p < block.end; ++p) {
            const Stress<D> trial = load<D>(stresses, p), stress = back(trial);
            plastic[p] += std::max(shear_of<D>(trial) - shear_of<D>(stress), 0.0) / shear_modulus;
            store<D>(stress, stresses, p);
        }
    };
}

/// The return, with or without dilation and the plastic strain: each costs where it is asked for.
template <int D>
PointKernel<D> make_kernel(const Values& values, const DruckerPrager& cone, Particles& particles) {
    const StressColumns<D> columns = add_stress_columns<D>(particles);
    const Elastic elastic = elastic_of(values);
    if (!keeps_plastic_strain(values))
        return cone.dilation > 0 ? dilating_kernel<D>(cone, elastic, columns)
                                 : return_kernel<D>(cone, columns);
    const Column plastic = particles.add_column("plastic_strain");
    const double bulk = elastic.bulk_modulus(), shear = elastic.shear_modulus();
    if (cone.dilation > 0)
        return keeping_kernel<D>(
            [=](const Stress<D>& trial) { return returned<D>(cone, bulk, shear, trial); }, shear,
            columns, plastic);
    return keeping_kernel<D>([=](const Stress<D>& trial) { return returned<D>(cone, trial); },
                             shear, columns, plastic);
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

DruckerPrager cone_of(const Values& values) {
    const MohrCoulomb strength{values.number("cohesion"), values.number("friction_angle"),
                               values.number("tension_cut_off"), values.number("dilation_angle")};
    if (strength.dilation_angle > strength.friction_angle)
        throw std::invalid_argument(
            "materials: the 'dilation_angle' of a drucker_prager must be at most its "
            "'friction_angle'");
    const std::string& match = values.word("match");
    if (match == "inner") return inner_cone(strength);
    return match == "outer" ? outer_cone(strength) : matched_cone(strength);
}

template <int D>
MaterialModel<D> build(const Values& values, Particles& particles) {
    MaterialModel<D> model = elastic_model<D>(values, particles);
    model.kernels.push_back({"drucker_prager", make_kernel<D>(values, cone_of(values), particles)});
    if (values.has("most_expansion")) {
        const double largest = values.number("most_expansion") / values.number("density");
        model.kernels.push_back(
            {"volume_limit", limit_kernel<D>(largest, particles.add_column("mass"),
                                             particles.add_column("volume"))});
    }
    return model;
}

std::vector<Rule> rules() {
    return elastic_rules({not_negative("cohesion", "Pa"),
                          within("friction_angle", "degrees", 0, 89),
                          within("dilation_angle", "degrees", 0, 89, 0.0),
                          not_negative("tension_cut_off", "Pa", 0.0),
                          choice("match", {"plane_strain", "inner", "outer"}),
                          plastic_strain_rule(), optional(within("most_expansion", "", 1, 1e6))});
}

}  // namespace

DruckerPrager matched_cone(const MohrCoulomb& strength) {
    const double sine = sine_of(strength.dilation_angle);
    const double dilation = sine / std::sqrt(1 + sine * sine / 3);
    const double circle =
        std::sqrt(1 - dilation * dilation / 3) + dilation * sine_of(strength.friction_angle) / 3;
    return cone_of(strength, 1 / circle, dilation);
}

DruckerPrager inner_cone(const MohrCoulomb& strength) {
    return triaxial_cone(strength, 1);
}

DruckerPrager outer_cone(const MohrCoulomb& strength) {
    return triaxial_cone(strength, -1);
}

MaterialKind drucker_prager_material() {
    return {"drucker_prager", rules(), elastic_wave_speed, build<2>, build<3>};
}

}  // namespace mpm
