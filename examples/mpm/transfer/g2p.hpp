#pragma once

#include "transfer/p2g.hpp"

namespace mpm {

/// Multiplies the values of a run's nodes by the weights along one axis, and sums over this axis.
template <std::size_t N, std::size_t stride, std::size_t size>
[[gnu::always_inline]] inline std::array<double, size / N> contracted(
    const std::array<double, size>& values, const std::array<double, N>& weights) {
    std::array<double, size / N> result;
    unrolled<size / N>([&](auto r) __attribute__((always_inline)) {
        constexpr std::size_t first = r / stride * stride * N + r % stride;
        double sum = weights[0] * values[first];
        unrolled<N - 1>([&](auto k) __attribute__((always_inline)) {
            sum += weights[k + 1] * values[first + (k + 1) * stride];
        });
        result[r] = sum;
    });
    return result;
}

/// Returns a nodal value interpolated at a point. `factors` contains the weights along each axis.
template <int D, std::size_t N>
[[gnu::always_inline]] inline double interpolated(
    const std::array<double, power(N, D)>& values,
    const std::array<std::array<double, N>, D>& factors) {
    const auto line = contracted<N, 1>(values, factors[0]);
    if constexpr (D == 2) {
        return contracted<N, 1>(line, factors[1])[0];
    } else {
        return contracted<N, 1>(contracted<N, 1>(line, factors[1]), factors[2])[0];
    }
}

template <int D, std::size_t N>
[[gnu::always_inline]] inline std::array<std::array<double, N>, D> values_of(
    const std::array<Weights<N>, D>& weights) {
    std::array<std::array<double, N>, D> factors;
    unrolled<D>([&](auto a) { factors[a] = weights[a].value; });
    return factors;
}

/// Returns the derivative of a nodal value along an axis, per cell.
///
/// Linear functions have one difference along each edge of the cell, which is the same for all
/// points of the cell. With two nodes the axis itself is therefore summed first, and compilers move
/// that sum out of the loop over points.
template <int D, std::size_t N, std::size_t axis>
[[gnu::always_inline]] inline double slope_at(const std::array<double, power(N, D)>& values,
                                              const std::array<Weights<N>, D>& weights) {
    if constexpr (N == 2) {
        const auto rest = contracted<N, power(N, axis)>(values, weights[axis].slope);
        const auto line = contracted<N, 1>(rest, weights[axis == 0 ? 1 : 0].value);
        if constexpr (D == 2)
            return line[0];
        else
            return contracted<N, 1>(line, weights[axis == 2 ? 1 : 2].value)[0];
    } else {
        auto factors = values_of<D, N>(weights);
        factors[axis] = weights[axis].slope;
        return interpolated<D, N>(values, factors);
    }
}

/// The motion of a run's nodes, one array per component.
template <int D, std::size_t N>
struct RunMotion {
    using Values = std::array<double, power(N, D)>;
    std::array<Values, D> velocity, change;

    RunMotion(const NodeMotion<D>* lowest, const std::array<std::size_t, power(N, D)>& offsets) {
        for (std::size_t n = 0; n < offsets.size(); ++n)
            for (std::size_t a = 0; a < D; ++a) {
                velocity[a][n] = lowest[offsets[n]].velocity[a];
                change[a][n] = lowest[offsets[n]].velocity_change[a];
            }
    }
};

/// The columns of the points that g2p changes.
template <int D>
struct PointWriter {
    PointWriter(Particles& particles, const TransferColumns<D>& columns)
        : volume(particles.data(columns.motion.volume)) {
        for (std::size_t a = 0; a < D; ++a) {
            position[a] = particles.data(columns.motion.position[a]);
            velocity[a] = particles.data(columns.motion.velocity[a]);
        }
    }

    std::array<double*, D> position, velocity;
    double* volume;
};

/// Returns the rate of the change of volume at the centre of a run, times the spacing of the nodes.
template <int D, std::size_t N>
[[gnu::always_inline]] inline double centre_expansion(
    const std::array<Components<D>, power(N, D)>& slopes, const RunMotion<D, N>& motion) {
    double expansion = 0;
    for (std::size_t n = 0; n < slopes.size(); ++n)
        for (std::size_t a = 0; a < D; ++a) expansion += slopes[n][a] * motion.velocity[a][n];
    return expansion;
}

/// Moves the points of a run with the nodes. Points keep their velocity and add the change of the
/// nodes' velocity (FLIP), so that the transfer does not damp them.
///
/// If the points share their change of volume, they use that of their centre and keep their own
/// shear.
template <int D, class Shape, VolumeChange change>
[[gnu::always_inline]] inline void move_run(const PointWriter<D>& to, const Shape& shape,
                                            const CellRun<D>& run,
                                            const RunMotion<D, Shape::num_nodes>& motion,
                                            double centre, double spacing,
                                            const PointBlock<D>& block) {
    constexpr std::size_t N = Shape::num_nodes;
    const double inverse_spacing = 1 / spacing, time_step = block.time_step;
    const PointWriter<D> points = to;
    const Components<D> corner = run.corner;
    std::array<std::array<double*, D>, D> gradient;
    for (std::size_t a = 0; a < D; ++a)
        for (std::size_t b = 0; b < D; ++b)
            gradient[a][b] = block.gradient(a, b) + (run.begin - block.begin);
    const std::size_t begin = run.begin, end = run.end;
#pragma GCC ivdep
    for (std::size_t p = begin; p < end; ++p) {
        const std::size_t k = p - begin;
        std::array<Weights<N>, D> weights;
        unrolled<D>([&](auto a) __attribute__((always_inline)) {
            weights[a] = shape.at((points.position[a][p] - corner[a]) * inverse_spacing);
        });
        double expansion = 0;
        unrolled<D>([&](auto a) __attribute__((always_inline)) {
            unrolled<D>([&](auto b) __attribute__((always_inline)) {
                const double slope =
                    inverse_spacing * slope_at<D, N, b>(motion.velocity[a], weights);
                gradient[a][b][k] = slope;
                if constexpr (a == b) expansion = a == 0 ? slope : expansion + slope;
            });
        });
        if constexpr (change == VolumeChange::shared) {
            const double more = (1.0 / D) * (centre - expansion);
            unrolled<D>([&](auto a) __attribute__((always_inline)) { gradient[a][a][k] += more; });
            expansion = centre;
        }
        points.volume[p] *= 1 + time_step * expansion;
        const auto values = values_of<D, N>(weights);
        unrolled<D>([&](auto a) __attribute__((always_inline)) {
            const double of_grid = interpolated<D, N>(motion.velocity[a], values);
            points.velocity[a][p] += interpolated<D, N>(motion.change[a], values);
            points.position[a][p] += time_step * of_grid;
        });
    }
}

template <int D, class Shape, VolumeChange change>
MPM_VECTOR_CLONES std::size_t grid_to_points(Particles& particles,
                                             const TransferColumns<D>& columns, const Shape& shape,
                                             const GridPatch<D>& patch,
                                             const std::vector<CellRun<D>>& runs,
                                             std::size_t first_run, const PointBlock<D>& block) {
    const PointWriter<D> target(particles, columns);
    const auto offsets = node_offsets<D, Shape::num_nodes>(patch);
    const auto slopes = centre_slopes<D>(shape);
    std::size_t run = first_run;
    for (; run < runs.size() && runs[run].begin < block.end; ++run) {
        const RunMotion<D, Shape::num_nodes> motion(patch.motion.data() + runs[run].node, offsets);
        const double centre = centre_expansion<D>(slopes, motion) / patch.shape.spacing;
        move_run<D, Shape, change>(target, shape, runs[run], motion, centre, patch.shape.spacing,
                                   block);
    }
    return run;
}

}  // namespace mpm
