#pragma once

#include "particles/vectors.hpp"
#include "transfer/shape_functions.hpp"
#include "transfer/transfers.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace mpm {

/// Calls visit(std::integral_constant<std::size_t, i>) for each i below N; the loop is unrolled.
template <std::size_t N, typename Visit>
[[gnu::always_inline]] inline void unrolled(Visit&& visit) {
    [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
        (visit(std::integral_constant<std::size_t, i>{}), ...);
    }
    (std::make_index_sequence<N>{});
}

constexpr std::size_t power(std::size_t base, std::size_t exponent) {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

/// The contribution of one point to its nodes.
template <int D>
struct Contribution {
    double mass;
    Components<D> momentum;
    Stress<D> stress;  ///< stress times volume and cells per metre
};

template <int D>
[[gnu::always_inline]] inline void add_force(const Components<D>& slope, const Stress<D>& stress,
                                             NodeSums<D>& node) {
    if constexpr (D == 2) {
        node.force[0] -= stress.xx * slope[0] + stress.xy * slope[1];
        node.force[1] -= stress.xy * slope[0] + stress.yy * slope[1];
    } else {
        node.force[0] -= stress.xx * slope[0] + stress.xy * slope[1] + stress.zx * slope[2];
        node.force[1] -= stress.xy * slope[0] + stress.yy * slope[1] + stress.yz * slope[2];
        node.force[2] -= stress.zx * slope[0] + stress.yz * slope[1] + stress.zz * slope[2];
    }
}

/// Returns the offset in the patch of each node of a run from the lowest node.
template <int D, std::size_t N>
std::array<std::size_t, power(N, D)> node_offsets(const GridPatch<D>& patch) {
    std::array<std::size_t, power(N, D)> offsets{};
    for (std::size_t n = 0; n < offsets.size(); ++n) {
        std::size_t stride = 1, digits = n;
        for (std::size_t a = 0; a < D; ++a) {
            offsets[n] += stride * (digits % N);
            digits /= N;
            stride *= static_cast<std::size_t>(patch.nodes.count[a]);
        }
    }
    return offsets;
}

/// Returns the position along an axis of node `n` of a run, counted from the lowest node.
template <std::size_t N>
constexpr std::size_t digit(std::size_t n, std::size_t axis) {
    return n / power(N, axis) % N;
}

template <int D, std::size_t N, std::size_t n>
[[gnu::always_inline]] inline double weight_of(const std::array<Weights<N>, D>& weights) {
    double product = weights[0].value[digit<N>(n, 0)];
    unrolled<D - 1>([&](auto a) __attribute__((always_inline)) {
        product *= weights[a + 1].value[digit<N>(n, a + 1)];
    });
    return product;
}

/// Returns the derivative of a shape function along an axis, per cell.
template <int D, std::size_t N, std::size_t n, std::size_t axis>
[[gnu::always_inline]] inline double slope_of(const std::array<Weights<N>, D>& weights) {
    double product = weights[axis].slope[digit<N>(n, axis)];
    unrolled<D>([&](auto a) __attribute__((always_inline)) {
        if constexpr (a != axis) product *= weights[a].value[digit<N>(n, a)];
    });
    return product;
}

/// Returns the slopes of the nodes' shape functions at the centre of the points that share these
/// nodes, per cell. The points share a cell or the square around a node.
template <int D, class Shape>
std::array<Components<D>, power(Shape::num_nodes, D)> centre_slopes(const Shape& shape) {
    constexpr std::size_t N = Shape::num_nodes;
    std::array<Weights<N>, D> weights;
    weights.fill(shape.at(0.5 * (N - 1)));
    std::array<Components<D>, power(N, D)> slopes;
    unrolled<power(N, D)>([&](auto n) {
        unrolled<D>([&](auto a) { slopes[n][a] = slope_of<D, N, n, a>(weights); });
    });
    return slopes;
}

/// Subtracts the mean of the normal stresses from each of them, and returns it.
template <int D>
[[gnu::always_inline]] inline double take_axial_mean(Stress<D>& stress) {
    double sum = stress.xx + stress.yy;
    if constexpr (D == 3) sum += stress.zz;
    const double mean = (1.0 / D) * sum;
    stress.xx -= mean;
    stress.yy -= mean;
    if constexpr (D == 3) stress.zz -= mean;
    return mean;
}

/// The columns of the points that p2g reads.
template <int D>
struct PointReader {
    PointReader(Particles& particles, const TransferColumns<D>& columns)
        : mass(particles.data(columns.motion.mass)),
          volume(particles.data(columns.motion.volume)),
          stress(stress_pointers<D>(particles, columns.stress)) {
        for (std::size_t a = 0; a < D; ++a) {
            position[a] = particles.data(columns.motion.position[a]);
            velocity[a] = particles.data(columns.motion.velocity[a]);
        }
    }

    [[gnu::always_inline]] Contribution<D> at(std::size_t p, double inverse_spacing) const {
        Contribution<D> point;
        point.mass = mass[p];
        unrolled<D>([&](auto a) { point.momentum[a] = point.mass * velocity[a][p]; });
        const double factor = volume[p] * inverse_spacing;
        point.stress = load<D>(stress, p);
        point.stress.xx *= factor;
        point.stress.yy *= factor;
        point.stress.xy *= factor;
        if constexpr (D == 3) {
            point.stress.zz *= factor;
            point.stress.yz *= factor;
            point.stress.zx *= factor;
        }
        return point;
    }

    std::array<const double*, D> position, velocity;
    const double *mass, *volume;
    StressPointers<D> stress;
};

/// Sums the points of a run on its nodes. The loops over axes and nodes are unrolled. It computes
///
///     for each point p of the run
///         for each node n of the run
///             mass[n] += weight(n, p) * mass[p]
///             momentum[n] += weight(n, p) * mass[p] * velocity[p]
///             force[n] -= volume[p] * stress[p] * slope(n, p)
///
/// If the points share their change of volume, the mean of the normal stresses acts with the slopes
/// at the centre of the points instead of slope(n, p).
template <int D, class Shape, VolumeChange change>
[[gnu::always_inline]] inline std::array<NodeSums<D>, power(Shape::num_nodes, D)> sum_run(
    const PointReader<D>& from, const Shape& shape,
    const std::array<Components<D>, power(Shape::num_nodes, D)>& centre, const CellRun<D>& run,
    double spacing) {
    constexpr std::size_t N = Shape::num_nodes;
    const double inverse_spacing = 1 / spacing;
    std::array<NodeSums<D>, power(N, D)> sums{};
    double pull = 0;
    for (std::size_t p = run.begin; p < run.end; ++p) {
        std::array<Weights<N>, D> weights;
        unrolled<D>([&](auto a) __attribute__((always_inline)) {
            weights[a] = shape.at((from.position[a][p] - run.corner[a]) * inverse_spacing);
        });
        Contribution<D> point = from.at(p, inverse_spacing);
        if constexpr (change == VolumeChange::shared) pull += take_axial_mean(point.stress);
        unrolled<power(N, D)>([&](auto n) __attribute__((always_inline)) {
            const double weight = weight_of<D, N, n>(weights);
            sums[n].mass += weight * point.mass;
            Components<D> slope;
            unrolled<D>([&](auto a) __attribute__((always_inline)) {
                sums[n].momentum[a] += weight * point.momentum[a];
                slope[a] = slope_of<D, N, n, a>(weights);
            });
            add_force<D>(slope, point.stress, sums[n]);
        });
    }
    if constexpr (change == VolumeChange::shared)
        for (std::size_t n = 0; n < sums.size(); ++n)
            for (std::size_t a = 0; a < D; ++a) sums[n].force[a] -= pull * centre[n][a];
    return sums;
}

template <int D, class Shape, VolumeChange change>
MPM_VECTOR_CLONES void points_to_grid(Particles& particles, const TransferColumns<D>& columns,
                                      const Shape& shape, const std::vector<CellRun<D>>& runs,
                                      GridPatch<D>& patch) {
    const PointReader<D> source(particles, columns);
    const auto offsets = node_offsets<D, Shape::num_nodes>(patch);
    const auto centre = centre_slopes<D>(shape);
    std::ranges::fill(patch.sums, NodeSums<D>{});
    for (const CellRun<D>& run : runs) {
        const auto sums =
            sum_run<D, Shape, change>(source, shape, centre, run, patch.shape.spacing);
        NodeSums<D>* const lowest = patch.sums.data() + run.node;
        for (std::size_t n = 0; n < sums.size(); ++n) add(sums[n], lowest[offsets[n]]);
    }
}

}  // namespace mpm
