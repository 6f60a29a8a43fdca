#include "effects/effect.hpp"

#include <stdexcept>

namespace mpm {

namespace {

/// Side of a cell along an axis that its node number `n` is on: +1 the upper, -1 the lower.
double side(std::size_t n, std::size_t axis) {
    return (n >> axis & 1) != 0 ? 1 : -1;
}

/// Derivative along an axis of the shape function of node `n` at u in a cell, per cell.
template <int D>
double slope_at(const Components<D>& u, std::size_t n, std::size_t axis) {
    double slope = side(n, axis);
    for (std::size_t a = 0; a < D; ++a)
        if (a != axis) slope *= side(n, a) > 0 ? u[a] : 1 - u[a];
    return slope;
}

/// Divergence of the nodal velocities at the centre of the cell of a run, 1/s.
template <int D>
double divergence_at_centre(const GridPatch<D>& patch, const CellRun<D>& run) {
    constexpr double num_edges = 1 << (D - 1);
    double sum = 0;
    std::size_t n = 0;
    visit_run_nodes<D>(patch, run, [&](std::size_t node) {
        for (std::size_t a = 0; a < D; ++a)
            sum += side(n, a) * patch.motion[node].strain_velocity[a];
        ++n;
    });
    return sum / (num_edges * patch.shape.spacing);
}

/// Gives all points of a cell the volume change of its centre. Each point keeps its own shear.
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

/// Forces whose work is that of the stress in these strains.
///
/// The mean of the stresses along the axes acts at the centre of the cell, not at the point.
template <int D>
ScatterKernel<D> force_kernel(const MotionColumns& motion, const StressColumns<D>& stress) {
    return [=](const Particles& particles, std::span<const CellRun<D>> runs, GridPatch<D>& patch) {
        Components<D> centre;
        centre.fill(0.5);
        for (const CellRun<D>& run : runs)
            for (std::size_t p = run.begin; p < run.end; ++p) {
                double pull = 0;
                Components<D> u;
                for (std::size_t a = 0; a < D; ++a) {
                    // The first columns of stress are those along the axes.
                    pull += particles[stress[a]][p] / D;
                    u[a] = (particles[motion.position[a]][p] - run.corner[a]) / patch.shape.spacing;
                }
                pull *= particles[motion.volume][p] / patch.shape.spacing;
                std::size_t n = 0;
                visit_run_nodes<D>(patch, run, [&](std::size_t node) {
                    for (std::size_t a = 0; a < D; ++a)
                        patch.sums[node].force[a] -=
                            pull * (slope_at<D>(centre, n, a) - slope_at<D>(u, n, a));
                    ++n;
                });
            }
    };
}

template <int D>
void build(const EffectBuilder<D>& builder) {
    if (builder.scene.shape_function != ShapeFunction::linear)
        throw std::invalid_argument(
            "effects / locking_cure: needs linear shape functions; others lock much less");
    const MotionColumns motion = add_motion_columns(builder.particles, D);
    builder.stages.scatters.push_back(
        {"locking_cure", force_kernel<D>(motion, add_stress_columns<D>(builder.particles))});
    builder.stages.gradients.push_back({"locking_cure", average_kernel<D>(motion.volume)});
}

}  // namespace

/// A cure of locking near incompressibility: a point changes its volume as the centre of its cell
/// (selective reduced integration, as the B-bar method of Hughes 1980).
EffectKind locking_cure_effect() {
    return {"locking_cure", {}, build<2>, build<3>};
}

}  // namespace mpm
