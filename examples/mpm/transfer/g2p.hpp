#pragma once

#include "transfer/p2g.hpp"

namespace mpm {

/// Sums a tensor of values, one per node of a run, along the axis of the given stride.
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

/// A nodal value at a point; `factors` has the weights along each axis.
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

/// Derivative of a nodal value along an axis, per cell.
///
/// Linear functions have one difference along each edge, the same for all points of a cell. So with
/// two nodes the axis itself is summed first, and compilers take that sum out of the loop over
/// points.
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

/// Velocity gradient of the affine field along an axis.
///
/// For B-splines it is the first moment of the velocities, 4 / h^2 sum of weight * velocity *
/// lever. For linear functions it is the gradient. There a node with next to no mass would weigh as
/// much as any other, so it is the gradient of `strain`.
template <int D, std::size_t N, std::size_t axis>
[[gnu::always_inline]] inline double affine_at(const std::array<double, power(N, D)>& values,
                                               const std::array<double, power(N, D)>& strain,
                                               const std::array<Weights<N>, D>& weights, double u) {
    if constexpr (N == 2) {
        return slope_at<D, N, axis>(strain, weights);
    } else {
        auto factors = values_of<D, N>(weights);
        unrolled<N>([&](auto i) { factors[axis][i] *= 4 * (static_cast<double>(i) - u); });
        return interpolated<D, N>(values, factors);
    }
}

/// Nodal motion of one run, component by component.
template <int D, std::size_t N>
struct RunMotion {
    using Values = std::array<double, power(N, D)>;
    std::array<Values, D> velocity, change, strain;

    RunMotion(const NodeMotion<D>* lowest, const std::array<std::size_t, power(N, D)>& offsets) {
        for (std::size_t n = 0; n < offsets.size(); ++n)
            for (std::size_t a = 0; a < D; ++a) {
                velocity[a][n] = lowest[offsets[n]].velocity[a];
                change[a][n] = lowest[offsets[n]].velocity_change[a];
                strain[a][n] = lowest[offsets[n]].strain_velocity[a];
            }
    }
};

/// Columns of the points that g2p changes.
template <int D, bool is_affine>
struct PointWriter {
    PointWriter(Particles& particles, const TransferColumns<D>& columns)
        : volume(particles.data(columns.motion.volume)) {
        for (std::size_t a = 0; a < D; ++a) {
            position[a] = particles.data(columns.motion.position[a]);
            velocity[a] = particles.data(columns.motion.velocity[a]);
            for (std::size_t b = 0; is_affine && b < D; ++b)
                affine[a][b] = particles.data(columns.affine[a][b]);
        }
    }

    std::array<double*, D> position, velocity;
    std::array<std::array<double*, D>, D> affine;
    double* volume;
};

/// Velocity of a point after a step: its own with the change of the grid's, and a share
/// 1 - flip_share of the grid's in its place.
[[gnu::always_inline]] inline double flip_velocity(double flip_share, double velocity,
                                                   double change, double of_grid) {
    return flip_share * (velocity + change) + (1 - flip_share) * of_grid;
}

template <int D>
struct G2pFactors {
    double spacing, flip_share;
};

template <int D, class Shape, bool is_affine>
[[gnu::always_inline]] inline void move_run(const PointWriter<D, is_affine>& to, const Shape& shape,
                                            const CellRun<D>& run,
                                            const RunMotion<D, Shape::num_nodes>& motion,
                                            const G2pFactors<D>& factors,
                                            const PointBlock<D>& block) {
    constexpr std::size_t N = Shape::num_nodes;
    const double inverse_spacing = 1 / factors.spacing, flip = factors.flip_share;
    const double time_step = block.time_step;
    const StepGradients<D> gradients(block);
    const PointWriter<D, is_affine> points = to;
    const Components<D> corner = run.corner;
    std::array<std::array<double*, D>, D> gradient;
    for (std::size_t a = 0; a < D; ++a)
        for (std::size_t b = 0; b < D; ++b)
            gradient[a][b] = block.gradient(a, b) + (run.begin - block.begin);
    const std::size_t begin = run.begin, end = run.end;
#pragma GCC ivdep
    for (std::size_t p = begin; p < end; ++p) {
        const std::size_t k = p - begin;
        Components<D> u;
        std::array<Weights<N>, D> weights;
        unrolled<D>([&](auto a) __attribute__((always_inline)) {
            u[a] = (points.position[a][p] - corner[a]) * inverse_spacing;
            weights[a] = shape.at(u[a]);
        });
        double expansion = 0;
        unrolled<D>([&](auto a) __attribute__((always_inline)) {
            unrolled<D>([&](auto b) __attribute__((always_inline)) {
                const double slope = inverse_spacing * slope_at<D, N, b>(motion.strain[a], weights);
                gradient[a][b][k] = slope;
                if constexpr (a == b) expansion = a == 0 ? slope : expansion + slope;
            });
        });
        points.volume[p] *= 1 + time_step * expansion;
        const auto values = values_of<D, N>(weights);
        unrolled<D>([&](auto a) __attribute__((always_inline)) {
            const double of_grid = interpolated<D, N>(motion.velocity[a], values);
            // On linear functions, slopes that jump between cells would feed what points keep.
            if constexpr (is_affine && N == 2) {
                points.velocity[a][p] = of_grid;
            } else {
                const double change = interpolated<D, N>(motion.change[a], values);
                points.velocity[a][p] = flip_velocity(flip, points.velocity[a][p], change, of_grid);
            }
            if constexpr (is_affine) {
                unrolled<D>([&](auto b) __attribute__((always_inline)) {
                    points.affine[a][b][p] =
                        inverse_spacing *
                        affine_at<D, N, b>(motion.velocity[a], motion.strain[a], weights, u[b]);
                });
            }
            points.position[a][p] += time_step * of_grid;
        });
    }
}

template <int D, class Shape, bool is_affine>
MPM_VECTOR_CLONES std::size_t grid_to_points(Particles& particles,
                                             const TransferColumns<D>& columns, const Shape& shape,
                                             const FlipShare& flip, const GridPatch<D>& patch,
                                             const std::vector<CellRun<D>>& runs,
                                             std::size_t first_run, const PointBlock<D>& block) {
    const PointWriter<D, is_affine> target(particles, columns);
    const G2pFactors<D> factors{patch.shape.spacing, flip.over(block.time_step)};
    const auto offsets = node_offsets<D, Shape::num_nodes>(patch);
    std::size_t run = first_run;
    for (; run < runs.size() && runs[run].begin < block.end; ++run) {
        const RunMotion<D, Shape::num_nodes> motion(patch.motion.data() + runs[run].node, offsets);
        move_run<D, Shape, is_affine>(target, shape, runs[run], motion, factors, block);
    }
    return run;
}

}  // namespace mpm
