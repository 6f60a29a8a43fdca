#include "materials/elastic.hpp"

#include "particles/vector_clones.hpp"

#include <cmath>

namespace mpm {

double Elastic::wave_speed(double density) const {
    return std::sqrt((bulk_modulus() + 4 * shear_modulus() / 3) / density);
}

std::vector<Rule> elastic_rules() {
    Rule poisson = within("poissons_ratio", "", -1, 0.5);
    poisson.without_ends = true;
    return {positive("density", "kg/m^3"), positive("youngs_modulus", "Pa"), poisson};
}

std::vector<Rule> elastic_rules(std::vector<Rule> more) {
    std::vector<Rule> rules = elastic_rules();
    rules.insert(rules.end(), more.begin(), more.end());
    return rules;
}

Rule plastic_strain_rule() {
    return choice("plastic_strain", {"none", "kept"});
}

bool keeps_plastic_strain(const Values& values) {
    return values.word("plastic_strain") == "kept";
}

Elastic elastic_of(const Values& values) {
    return {values.number("youngs_modulus"), values.number("poissons_ratio")};
}

double elastic_wave_speed(const Values& values) {
    return elastic_of(values).wave_speed(values.number("density"));
}

namespace {

template <int D>
MPM_VECTOR_CLONES void strain(const StepGradients<D>& gradients, double bulk, double shear,
                              const StressPointers<D>& stresses, const PointBlock<D>& block) {
    const StressPointers<D> columns = stresses;
    const StepGradients<D> of_step = gradients;
    const std::size_t begin = block.begin, count = block.size();
#pragma GCC ivdep
    for (std::size_t k = 0; k < count; ++k) {
        const DisplacementGradient<D> gradient = of_step[k];
        const Stress<D> turned = rotated(load<D>(columns, begin + k), gradient);
        store<D>(strained(turned, gradient, bulk, shear), columns, begin + k);
    }
}

}  // namespace

template <int D>
PointKernel<D> elastic_kernel(const Elastic& elastic, const StressColumns<D>& columns) {
    return [bulk = elastic.bulk_modulus(), shear = elastic.shear_modulus(), columns](
               Particles& particles, const PointBlock<D>& block) {
        strain<D>(StepGradients<D>(block), bulk, shear, stress_pointers<D>(particles, columns),
                  block);
    };
}

namespace {

/// Energy per volume, p^2 / 2 K + s : s / 4 G.
template <int D>
double stored(const Elastic& elastic, const Stress<D>& stress) {
    const double pressure = mean(stress);
    return pressure * pressure / (2 * elastic.bulk_modulus()) +
           second_invariant(deviator(stress, pressure)) / (2 * elastic.shear_modulus());
}

}  // namespace

template <int D>
MaterialModel<D> elastic_model(const Values& values, Particles& particles) {
    const Elastic elastic = elastic_of(values);
    const StressColumns<D> columns = add_stress_columns<D>(particles);
    const Column volume = particles.add_column("volume");
    const auto energy = [=](const Particles& points, std::size_t p) {
        Stress<D> stress;
        stress.xx = points[columns[0]][p];
        stress.yy = points[columns[1]][p];
        stress.zz = points[columns[2]][p];
        stress.xy = points[columns[3]][p];
        if constexpr (D == 3) {
            stress.yz = points[columns[4]][p];
            stress.zx = points[columns[5]][p];
        }
        return points[volume][p] * stored(elastic, stress);
    };
    return {{{"elastic", elastic_kernel<D>(elastic, columns)}}, energy};
}

template PointKernel<2> elastic_kernel<2>(const Elastic&, const StressColumns<2>&);
template PointKernel<3> elastic_kernel<3>(const Elastic&, const StressColumns<3>&);
template MaterialModel<2> elastic_model<2>(const Values&, Particles&);
template MaterialModel<3> elastic_model<3>(const Values&, Particles&);

MaterialKind elastic_material() {
    return {"elastic", elastic_rules(), elastic_wave_speed, elastic_model<2>, elastic_model<3>};
}

}  // namespace mpm
