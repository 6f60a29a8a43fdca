#include "effects/effect.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

/// A node is at the surface if less than this share of its volume is filled.
constexpr double surface_share = 0.75;

struct Drag {
    double factor;                         ///< water density * coefficient / 2, kg/m^3
    std::size_t volume_field, mark_field;  ///< of the nodes
    std::size_t area_field;  ///< field of the first component of the outward area vector
    Column mark;             ///< 1 for a point in a cell with a node of the surface
};

/// Slows a node down in proportion to the area that faces its velocity. At most it stops the node.
template <int D>
void slow_down(double factor, const Components<D>& area, double time_step, NodeSums<D>& node) {
    double facing = 0;
    for (std::size_t a = 0; a < D; ++a) facing += node.momentum[a] / node.mass * area[a];
    if (!(facing > 0)) return;
    // Force divided by velocity: factor * (area that faces the motion) * speed.
    const double rate = std::min(factor * facing, node.mass / time_step);
    for (std::size_t a = 0; a < D; ++a) node.force[a] -= rate * node.momentum[a] / node.mass;
}

template <int D>
NodeKernel<D> force_kernel(const Drag& drag) {
    return [drag](GridPatch<D>& patch, const StepTime& step) {
        for (std::size_t n = 0; n < patch.sums.size(); ++n) {
            NodeSums<D>& node = patch.sums[n];
            if (!(node.mass > 0) || !(patch.fields[drag.mark_field][n] > 0)) continue;
            // By Gauss' theorem the integral of a shape function's gradient over the volume equals
            // the integral of the function times the outward normal over the surface.
            Components<D> area;
            for (std::size_t a = 0; a < D; ++a) area[a] = patch.fields[drag.area_field + a][n];
            slow_down<D>(drag.factor, area, step.time_step, node);
        }
    };
}

/// Marks the points that have a node at the surface: one filled by less than surface_share.
template <int D>
GradientKernel<D> mark_kernel(const Drag& drag, double full_volume) {
    const double least = surface_share * full_volume;
    return [=](Particles& particles, const GridPatch<D>& patch, std::span<const CellRun<D>> runs,
               const PointBlock<D>&) {
        const std::vector<double>& volume = patch.fields[drag.volume_field];
        double* const marks = particles.data(drag.mark);
        for (const CellRun<D>& run : runs) {
            bool is_surface = false;
            visit_run_nodes<D>(patch, run, [&](std::size_t n) { is_surface |= volume[n] < least; });
            std::fill(marks + run.begin, marks + run.end, is_surface ? 1.0 : 0.0);
        }
    };
}

template <int D>
void build(const EffectBuilder<D>& builder) {
    Stages<D>& stages = builder.stages;
    const std::size_t first = stages.fields.size();
    const Drag drag{.factor = 0.5 * builder.values.number("water_density") *
                              builder.values.number("drag_coefficient"),
                    .volume_field = first,
                    .mark_field = first + 1,
                    .area_field = first + 2,
                    .mark = builder.particles.add_column("water_surface")};
    const Column volume = builder.particles.add_column("volume");
    stages.fields.push_back({"node_volume", volume});
    stages.fields.push_back({"water_surface", drag.mark});
    for (int axis = 0; axis < D; ++axis)
        stages.fields.push_back(
            {"surface_area", volume, axis, axis, static_cast<int>(drag.mark_field)});
    stages.forces.push_back({"water_drag", force_kernel<D>(drag)});
    stages.gradients.push_back(
        {"water_surface", mark_kernel<D>(drag, std::pow(builder.scene.grid.spacing, D))});
}

}  // namespace

/// Applies the quadratic drag of still water, density * coefficient * area * speed^2 / 2, to the
/// surface that faces the motion.
///
/// It acts on the nodes of surface points. These are the points that, in the previous step, were in
/// a cell with a node less than three quarters full.
EffectKind water_drag_effect() {
    return {"water_drag",
            {not_negative("water_density", "kg/m^3"), not_negative("drag_coefficient", "")},
            build<2>,
            build<3>};
}

}  // namespace mpm
