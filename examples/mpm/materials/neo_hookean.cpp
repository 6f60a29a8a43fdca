#include "materials/neo_hookean.hpp"

namespace mpm {

namespace {

template <int D>
using DeformationColumns = std::array<std::array<Column, D>, D>;

template <int D>
DeformationColumns<D> add_deformation_columns(Particles& particles) {
    DeformationColumns<D> columns{};
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = 0; j < D; ++j)
            columns[i][j] = particles.add_column(std::string("deformation_") + "xyz"[i] + "xyz"[j],
                                                 i == j ? 1 : 0);
    return columns;
}

template <int D>
Deformation<D> deformation_of(const Particles& particles, const DeformationColumns<D>& columns,
                              std::size_t p) {
    Deformation<D> f;
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = 0; j < D; ++j) f[i][j] = particles[columns[i][j]][p];
    return f;
}

template <int D>
MaterialModel<D> build(const Values& values, Particles& particles) {
    const Elastic elastic = elastic_of(values);
    const double density = values.number("density");
    const StressColumns<D> stress_columns = add_stress_columns<D>(particles);
    const DeformationColumns<D> columns = add_deformation_columns<D>(particles);
    const Column mass = particles.add_column("mass"), volume = particles.add_column("volume");
    const auto kernel = [=](Particles& points, const PointBlock<D>& block) {
        const StressPointers<D> stresses = stress_pointers<D>(points, stress_columns);
        const StepGradients<D> gradients(block);
        double* const volumes = points.data(volume);
        const double* const masses = points.data(mass);
        for (std::size_t p = block.begin; p < block.end; ++p) {
            const Deformation<D> f =
                deformed<D>(deformation_of<D>(points, columns, p), gradients[p - block.begin]);
            for (std::size_t i = 0; i < D; ++i)
                for (std::size_t j = 0; j < D; ++j) points.data(columns[i][j])[p] = f[i][j];
            volumes[p] = determinant<D>(f) * masses[p] / density;
            store<D>(neo_hookean_stress<D>(elastic, f), stresses, p);
        }
    };
    const auto energy = [=](const Particles& points, std::size_t p) {
        return points[mass][p] / density *
               neo_hookean_energy<D>(elastic, deformation_of<D>(points, columns, p));
    };
    return {{{"neo_hookean", kernel}}, energy};
}

}  // namespace

MaterialKind neo_hookean_material() {
    return {"neo_hookean", elastic_rules(), elastic_wave_speed, build<2>, build<3>};
}

}  // namespace mpm
