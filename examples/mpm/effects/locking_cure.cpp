#include "effects/effect.hpp"
#include "transfer/p2g.hpp"

namespace mpm {

namespace {

/// Shape functions at the centre of the points that share their nodes: of a cell, or of the square
/// around a node.
template <int D, class Shape>
struct Centre {
    static constexpr std::size_t num_nodes = power(Shape::num_nodes, D);
    using Slopes = std::array<Components<D>, num_nodes>;  ///< per cell

    static Slopes slopes_at(const Shape& shape, const Components<D>& u) {
        std::array<Weights<Shape::num_nodes>, D> weights;
        for (std::size_t a = 0; a < D; ++a) weights[a] = shape.at(u[a]);
        Slopes slopes;
        unrolled<num_nodes>([&](auto n) {
            unrolled<D>(
                [&](auto a) { slopes[n][a] = slope_of<D, Shape::num_nodes, n, a>(weights); });
        });
        return slopes;
    }

    static Slopes slopes() {
        Components<D> centre;
        centre.fill(0.5 * (Shape::num_nodes - 1));
        return slopes_at(Shape(), centre);
    }
};

/// Gives all points of a run the volume change of its centre. Each point keeps its own shear.
template <int D, class Shape>
GradientKernel<D> average_kernel(Column volume) {
    return [volume, slopes = Centre<D, Shape>::slopes()](
               Particles& particles, const GridPatch<D>& patch, std::span<const CellRun<D>> runs,
               const PointBlock<D>& block) {
        double* const volumes = particles.data(volume);
        const auto offsets = node_offsets<D, Shape::num_nodes>(patch);
        for (const CellRun<D>& run : runs) {
            double centre = 0;
            for (std::size_t n = 0; n < offsets.size(); ++n)
                for (std::size_t a = 0; a < D; ++a)
                    centre += slopes[n][a] * patch.motion[run.node + offsets[n]].strain_velocity[a];
            centre /= patch.shape.spacing;
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

/// Forces whose work is that of the stress in these strains: the mean of the stresses along the
/// axes acts at the centre, not at the point.
template <int D, class Shape>
ScatterKernel<D> force_kernel(const Shape& shape, const MotionColumns& motion,
                              const StressColumns<D>& stress) {
    return [=, slopes = Centre<D, Shape>::slopes()](
               const Particles& particles, std::span<const CellRun<D>> runs, GridPatch<D>& patch) {
        const auto offsets = node_offsets<D, Shape::num_nodes>(patch);
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
                const auto own = Centre<D, Shape>::slopes_at(shape, u);
                for (std::size_t n = 0; n < own.size(); ++n)
                    for (std::size_t a = 0; a < D; ++a)
                        patch.sums[run.node + offsets[n]].force[a] -=
                            pull * (slopes[n][a] - own[n][a]);
            }
    };
}

template <int D, class Shape>
void add(const EffectBuilder<D>& builder) {
    const MotionColumns motion = add_motion_columns(builder.particles, D);
    const StressColumns<D> stress = add_stress_columns<D>(builder.particles);
    builder.stages.scatters.push_back(
        {"locking_cure", force_kernel<D>(Shape(builder.scene.courant_number), motion, stress)});
    builder.stages.gradients.push_back({"locking_cure", average_kernel<D, Shape>(motion.volume)});
}

template <int D>
void build(const EffectBuilder<D>& builder) {
    if (builder.scene.shape_function == ShapeFunction::linear)
        add<D, LinearShape>(builder);
    else
        add<D, QuadraticShape>(builder);
}

}  // namespace

/// A cure of locking where volume is kept: the points that share their nodes change their volume as
/// their centre (selective reduced integration, as the B-bar method of Hughes 1980).
EffectKind locking_cure_effect() {
    return {"locking_cure", {}, build<2>, build<3>};
}

}  // namespace mpm
