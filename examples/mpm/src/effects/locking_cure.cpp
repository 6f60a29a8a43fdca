#include <mpm/effect.hpp>

#include <stdexcept>

namespace mpm {

namespace {

/// Divergence of the nodal velocities at the centre of the cell of a run, 1/s.
template <int D>
double divergence_at_centre(const GridPatch<D>& patch, const CellRun<D>& run) {
    constexpr double num_edges = 1 << (D - 1);
    double sum = 0;
    std::size_t n = 0;
    visit_run_nodes<D>(patch, run, [&](std::size_t node) {
        for (std::size_t a = 0; a < D; ++a) {
            const double velocity = patch.motion[node].strain_velocity[a];
            sum += (n >> a & 1) != 0 ? velocity : -velocity;
        }
        ++n;
    });
    return sum / (num_edges * patch.shape.spacing);
}

/// Gives all points of a cell the volume change of its centre; shear stays each point's own.
template <int D>
GradientKernel<D> average_kernel(Column volume) {
    return [volume](Particles& particles, const GridPatch<D>& patch,
                    std::span<const CellRun<D>> runs, const PointBlock<D>& block) {
        double* const volumes = particles.data(volume);
        for (const CellRun<D>& run : runs) {
            const double centre = divergence_at_centre<D>(patch, run);
            for (std::size_t p = run.begin; p < run.end; ++p) {
                double own = 0;
                for (std::size_t a = 0; a < D; ++a) own += block.gradient(a, a)[p - block.begin];
                for (std::size_t a = 0; a < D; ++a)
                    block.gradient(a, a)[p - block.begin] += (centre - own) / D;
                volumes[p] *= (1 + block.time_step * centre) / (1 + block.time_step * own);
            }
        }
    };
}

template <int D>
void build(const EffectBuilder<D>& builder) {
    if (builder.scene.shape_function != ShapeFunction::linear)
        throw std::invalid_argument(
            "effects / locking_cure: needs linear shape functions; others lock much less");
    const Column volume = builder.particles.add_column("volume");
    builder.stages.gradients.push_back({"locking_cure", average_kernel<D>(volume)});
}

}  // namespace

/// Against locking near incompressibility: the volume change of a point is that of the centre of
/// its cell (selective reduced integration, as the B-bar method of Hughes 1980).
EffectKind locking_cure_effect() {
    return {"locking_cure", {}, build<2>, build<3>};
}

}  // namespace mpm
