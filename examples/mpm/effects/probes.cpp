#include "effects/probes.hpp"

#include "materials/elastic.hpp"
#include "scene/lattice.hpp"

namespace mpm {

std::vector<Vector> probed_points(const Scene& scene) {
    std::vector<Vector> points;
    for (const Probe& probe : scene.probes) points.push_back(nearest_point(scene, probe.position));
    return points;
}

namespace {

/// Kernel that adds the strain of the step to that of the points with a probe.
template <int D>
PointKernel<D> strain_kernel(Column probe, const StressColumns<D>& columns) {
    return [=](Particles& particles, const PointBlock<D>& block) {
        // With such moduli stress is strain.
        constexpr double bulk = 1.0 / 3, shear = 0.5;
        const StressPointers<D> strains = stress_pointers<D>(particles, columns);
        const StepGradients<D> gradients(block);
        for (std::size_t p = block.begin; p < block.end; ++p) {
            if (particles[probe][p] == 0) continue;
            const DisplacementGradient<D> g = gradients[p - block.begin];
            store<D>(strained(rotated(load<D>(strains, p), g), g, bulk, shear), strains, p);
        }
    };
}

}  // namespace

template <int D>
StressColumns<D> add_strain_columns(Particles& particles) {
    constexpr std::array<const char*, 6> names{"xx", "yy", "zz", "xy", "yz", "zx"};
    StressColumns<D> columns{};
    for (std::size_t c = 0; c < columns.size(); ++c)
        columns[c] = particles.add_column(std::string("strain_") + names[c]);
    return columns;
}

template <int D>
void add_probes(const Scene& scene, Particles& particles, Stages<D>& stages) {
    const MotionColumns motion = add_motion_columns(particles, D);
    const Column probe = particles.add_column(probe_column);
    const StressColumns<D> columns = add_strain_columns<D>(particles);
    stages.preparations.push_back([=, points = probed_points(scene)](Particles& all) {
        const Positions positions = positions_of(all, motion, D);
        // From the last on, so that the first of those that follow one point marks it.
        for (std::size_t k = points.size(); k-- > 0;)
            for (std::size_t p = 0; p < all.size(); ++p)
                if (positions[p] == points[k]) all.data(probe)[p] = static_cast<double>(k + 1);
    });
    stages.before_materials.push_back({"probes", strain_kernel<D>(probe, columns)});
}

template StressColumns<2> add_strain_columns<2>(Particles&);
template StressColumns<3> add_strain_columns<3>(Particles&);
template void add_probes<2>(const Scene&, Particles&, Stages<2>&);
template void add_probes<3>(const Scene&, Particles&, Stages<3>&);

}  // namespace mpm
