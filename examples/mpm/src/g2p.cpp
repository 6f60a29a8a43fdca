#include <mpm/transfer.hpp>

namespace mpm {

namespace {

/// The columns g2p changes.
struct Target {
    double *x, *y, *velocity_x, *velocity_y, *displacement_x, *displacement_y, *volume;
};

struct Factors {
    double inverse_spacing, flip_fraction, time_step;
};

/// One component of a nodal vector on the corners of a cell.
struct Corners {
    double lower_left, lower_right, upper_left, upper_right;

    double at(double right, double upper) const {
        const double left = 1 - right;
        return (1 - upper) * (left * lower_left + right * lower_right) +
               upper * (left * upper_left + right * upper_right);
    }
    double slope_along_x(double upper) const {
        return (1 - upper) * (lower_right - lower_left) + upper * (upper_right - upper_left);
    }
    double slope_along_y(double right) const {
        return (1 - right) * (upper_left - lower_left) + right * (upper_right - lower_right);
    }
};

struct CellMotion {
    Corners velocity[2], change[2], strain[2];
};

Corners corners_of(const NodeMotion* lower, const NodeMotion* upper, Vector NodeMotion::*member,
                   std::size_t axis) {
    return {(lower[0].*member)[axis], (lower[1].*member)[axis], (upper[0].*member)[axis],
            (upper[1].*member)[axis]};
}

CellMotion motion_of(const GridPatch& patch, const CellRun& run) {
    const NodeMotion* const lower = patch.motion.data() + run.node;
    const NodeMotion* const upper = lower + patch.nodes.count[0];
    CellMotion cell;
    for (std::size_t a = 0; a < 2; ++a) {
        cell.velocity[a] = corners_of(lower, upper, &NodeMotion::velocity, a);
        cell.change[a] = corners_of(lower, upper, &NodeMotion::velocity_change, a);
        cell.strain[a] = corners_of(lower, upper, &NodeMotion::strain_velocity, a);
    }
    return cell;
}

void move_run(const Target& to, const CellRun& run, const CellMotion& cell, const Factors& factors,
              PointBlock& block) {
    double* __restrict x = to.x;
    double* __restrict y = to.y;
    double* __restrict velocity_x = to.velocity_x;
    double* __restrict velocity_y = to.velocity_y;
    double* __restrict displacement_x = to.displacement_x;
    double* __restrict displacement_y = to.displacement_y;
    double* __restrict volume = to.volume;
    double* __restrict gradient_xx = block.gradients.xx.data();
    double* __restrict gradient_xy = block.gradients.xy.data();
    double* __restrict gradient_yx = block.gradients.yx.data();
    double* __restrict gradient_yy = block.gradients.yy.data();
    const auto [inverse_spacing, flip, time_step] = factors;
    const CellMotion c = cell;
    const Vector corner = run.corner;
    const std::size_t block_begin = block.begin;
    for (std::size_t p = run.begin; p < run.end; ++p) {
        const double right = (x[p] - corner[0]) * inverse_spacing;
        const double upper = (y[p] - corner[1]) * inverse_spacing;

        const std::size_t k = p - block_begin;
        gradient_xx[k] = inverse_spacing * c.strain[0].slope_along_x(upper);
        gradient_xy[k] = inverse_spacing * c.strain[0].slope_along_y(right);
        gradient_yx[k] = inverse_spacing * c.strain[1].slope_along_x(upper);
        gradient_yy[k] = inverse_spacing * c.strain[1].slope_along_y(right);
        volume[p] *= 1 + time_step * (gradient_xx[k] + gradient_yy[k]);

        const double grid_x = c.velocity[0].at(right, upper);
        const double grid_y = c.velocity[1].at(right, upper);
        velocity_x[p] = flip * (velocity_x[p] + c.change[0].at(right, upper)) + (1 - flip) * grid_x;
        velocity_y[p] = flip * (velocity_y[p] + c.change[1].at(right, upper)) + (1 - flip) * grid_y;
        x[p] += time_step * grid_x;
        y[p] += time_step * grid_y;
        displacement_x[p] += time_step * grid_x;
        displacement_y[p] += time_step * grid_y;
    }
}

}  // namespace

std::size_t g2p(Particles& particles, const MotionColumns& motion, const GridPatch& patch,
                const std::vector<CellRun>& runs, std::size_t first_run, double flip_fraction,
                PointBlock& block) {
    const Target target{particles.data(motion.x),
                        particles.data(motion.y),
                        particles.data(motion.velocity_x),
                        particles.data(motion.velocity_y),
                        particles.data(motion.displacement_x),
                        particles.data(motion.displacement_y),
                        particles.data(motion.volume)};
    const Factors factors{1 / patch.shape.spacing, flip_fraction, block.time_step};
    std::size_t run = first_run;
    for (; run < runs.size() && runs[run].begin < block.end; ++run)
        move_run(target, runs[run], motion_of(patch, runs[run]), factors, block);
    return run;
}

}  // namespace mpm
