#include <mpm/transfer.hpp>

#include <algorithm>

namespace mpm {

namespace {

/// The columns p2g reads.
struct Source {
    const double *x, *y, *velocity_x, *velocity_y, *mass, *volume, *xx, *yy, *xy;
};

/// Sums of one cell, per corner: lower left, lower right, upper left, upper right.
struct CellSums {
    Node corners[4];
};

inline void add_motion(double weight, double mass, double momentum_x, double momentum_y,
                       Node& node) {
    node.mass += weight * mass;
    node.momentum[0] += weight * momentum_x;
    node.momentum[1] += weight * momentum_y;
}

inline void add_force(double gradient_x, double gradient_y, const Stress& stress, Node& node) {
    node.force[0] -= stress.xx * gradient_x + stress.xy * gradient_y;
    node.force[1] -= stress.xy * gradient_x + stress.yy * gradient_y;
}

CellSums sum_run(const Source& from, const CellRun& run, double inverse_spacing) {
    CellSums sums;
    for (std::size_t p = run.begin; p < run.end; ++p) {
        const double right = (from.x[p] - run.corner[0]) * inverse_spacing, left = 1 - right;
        const double upper = (from.y[p] - run.corner[1]) * inverse_spacing, lower = 1 - upper;
        const double mass = from.mass[p];
        const double momentum_x = mass * from.velocity_x[p], momentum_y = mass * from.velocity_y[p];
        add_motion(left * lower, mass, momentum_x, momentum_y, sums.corners[0]);
        add_motion(right * lower, mass, momentum_x, momentum_y, sums.corners[1]);
        add_motion(left * upper, mass, momentum_x, momentum_y, sums.corners[2]);
        add_motion(right * upper, mass, momentum_x, momentum_y, sums.corners[3]);

        const double factor = from.volume[p] * inverse_spacing;
        const Stress stress{factor * from.xx[p], factor * from.yy[p], 0, factor * from.xy[p]};
        add_force(-lower, -left, stress, sums.corners[0]);
        add_force(lower, -right, stress, sums.corners[1]);
        add_force(-upper, left, stress, sums.corners[2]);
        add_force(upper, right, stress, sums.corners[3]);
    }
    return sums;
}

}  // namespace

void p2g(Particles& particles, const MotionColumns& motion, const StressColumns& stress,
         const std::vector<CellRun>& runs, GridPatch& patch) {
    const Source source{particles.data(motion.x),          particles.data(motion.y),
                        particles.data(motion.velocity_x), particles.data(motion.velocity_y),
                        particles.data(motion.mass),       particles.data(motion.volume),
                        particles.data(stress.xx),         particles.data(stress.yy),
                        particles.data(stress.xy)};
    const double inverse_spacing = 1 / patch.shape.spacing;
    std::ranges::fill(patch.sums, Node{});
    for (const CellRun& run : runs) {
        const CellSums sums = sum_run(source, run, inverse_spacing);
        Node* const lower = patch.sums.data() + run.node;
        Node* const upper = lower + patch.nodes.count[0];
        add(sums.corners[0], lower[0]);
        add(sums.corners[1], lower[1]);
        add(sums.corners[2], upper[0]);
        add(sums.corners[3], upper[1]);
    }
}

}  // namespace mpm
