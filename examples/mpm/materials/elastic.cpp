#include "materials/elastic.hpp"

#include "particles/vectors.hpp"

#include <cmath>

namespace mpm {

double Elastic::wave_speed(double density) const {
    return std::sqrt((bulk_modulus() + 4 * shear_modulus() / 3) / density);
}

std::vector<Rule> elastic_rules(const std::vector<Rule>& more) {
    Rule poisson = within("poissons_ratio", "", -1, 0.5);
    poisson.without_ends = true;
    std::vector<Rule> rules{positive("density", "kg/m^3"), positive("youngs_modulus", "Pa"),
                            poisson};
    rules.insert(rules.end(), more.begin(), more.end());
    return rules;
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
        store<D>(strained<D>(turned, gradient, bulk, shear), columns, begin + k);
    }
}

/// Returns the elastic energy per volume, p^2 / 2 K + s : s / 4 G.
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
        std::array<double, num_stresses<D>> stress;
        for (std::size_t c = 0; c < stress.size(); ++c) stress[c] = points[columns[c]][p];
        StressPointers<D> pointers;
        for (std::size_t c = 0; c < stress.size(); ++c) pointers[c] = &stress[c];
        return points[volume][p] * stored(elastic, load<D>(pointers, 0));
    };
    const auto kernel = [bulk = elastic.bulk_modulus(), shear = elastic.shear_modulus(), columns](
                            Particles& points, const PointBlock<D>& block) {
        strain<D>(StepGradients<D>(block), bulk, shear, stress_pointers<D>(points, columns), block);
    };
    return {{{"elastic", kernel}}, energy};
}

template MaterialModel<2> elastic_model<2>(const Values&, Particles&);
template MaterialModel<3> elastic_model<3>(const Values&, Particles&);

MaterialKind elastic_material() {
    return {"elastic", elastic_rules(), elastic_wave_speed, elastic_model<2>, elastic_model<3>};
}

}  // namespace mpm
