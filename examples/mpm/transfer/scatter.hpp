#pragma once

#include "transfer/p2g.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace mpm {

/// The number of consecutive points that are skipped together if a column is 0 for all of them.
inline constexpr std::size_t skipped_together = 32;

/// Returns the first index of the next group of `skipped_together` points, from `begin` on, in
/// which a column is not 0 everywhere, or `size` if there is none.
[[gnu::always_inline]] inline std::size_t next_filled(const double* values, std::size_t begin,
                                                      std::size_t size) {
    for (; begin < size; begin += skipped_together) {
        const std::size_t end = std::min(begin + skipped_together, size);
        std::uint64_t bits = 0;
        for (std::size_t p = begin; p < end; ++p) bits |= std::bit_cast<std::uint64_t>(values[p]);
        if (bits != 0) break;
    }
    return std::min(begin, size);
}

/// Adds a column of the points to a field of the nodes, with the weights of Transfers::scatter.
template <int D, class Shape>
MPM_VECTOR_CLONES void scatter_column(const std::array<const double*, D>& at,
                                      std::span<const double> values, const Shape& shape,
                                      std::span<const CellRun<D>> runs, const GridPatch<D>& patch,
                                      double* field) {
    constexpr std::size_t N = Shape::num_nodes;
    const auto offsets = node_offsets<D, N>(patch);
    const double inverse_spacing = 1 / patch.shape.spacing;
    std::size_t filled = next_filled(values.data(), 0, values.size());
    for (const CellRun<D>& run : runs) {
        if (run.end <= filled) continue;
        std::array<double, power(N, D)> sums;
        for (std::size_t n = 0; n < sums.size(); ++n) sums[n] = field[run.node + offsets[n]];
        for (std::size_t p = run.begin; p < run.end; ++p) {
            if (values[p] == 0) continue;
            std::array<Weights<N>, D> weights;
            unrolled<D>([&](auto a) __attribute__((always_inline)) {
                weights[a] = shape.at((at[a][p] - run.corner[a]) * inverse_spacing);
            });
            unrolled<power(N, D)>([&](auto n) __attribute__((always_inline)) {
                sums[n] += weight_of<D, N, n>(weights) * values[p];
            });
        }
        for (std::size_t n = 0; n < sums.size(); ++n) field[run.node + offsets[n]] = sums[n];
        if (run.end >= filled + skipped_together)
            filled = next_filled(values.data(), run.end, values.size());
    }
}

}  // namespace mpm
