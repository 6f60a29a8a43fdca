#include "point_layout.hpp"

#include <rrcb/moments.hpp>

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

/// Sums over up to `length` points of one cell, relative to `origin`.
///
/// A block starts at the mean of the cell so far: what a difference from the origin loses by
/// cancellation is then small against the second moment it is merged into.
template <std::size_t Dimension>
struct Block {
    static constexpr std::uint32_t length = 64;
    std::uint32_t count = 0;
    double weight = 0;
    std::array<double, Dimension> origin;
    std::array<double, Dimension> sum{};
    std::array<double, Dimension> square{};
};

/// Moments of the finished blocks of one cell, in scaled coordinates, with squares of lengths.
///
/// The mean is kept relative to a position of the cell: rounded to a coordinate it would be too
/// coarse for the distances between means where the cell is small against its offset.
template <std::size_t Dimension>
struct Total {
    GlobalCount count = 0;
    double weight = 0;
    std::array<double, Dimension> anchor{};
    std::array<double, Dimension> mean{};
    std::array<double, Dimension> central{};

    /// Chan's formula, with the block's own central moments.
    void absorb(const Block<Dimension>& block) {
        if (count == 0) anchor = block.origin;
        count += block.count;
        if (!(block.weight > 0)) return;
        const double joint = weight + block.weight;
        const double share = block.weight / joint;
        for (std::size_t a = 0; a < Dimension; ++a) {
            const double shift = block.sum[a] / block.weight;
            const double block_central = std::max(0.0, block.square[a] - block.sum[a] * shift);
            const double distance = block.origin[a] - anchor[a] + shift - mean[a];
            central[a] += block_central + distance * distance * (weight * share);
            mean[a] += distance * share;
        }
        weight = joint;
    }

    std::array<double, Dimension> centroid() const {
        std::array<double, Dimension> position;
        for (std::size_t a = 0; a < Dimension; ++a) position[a] = anchor[a] + mean[a];
        return position;
    }
};

template <bool Weighted, std::size_t Dimension>
struct Accumulator {
    std::vector<Block<Dimension>> blocks;
    std::vector<Total<Dimension>> totals;

    explicit Accumulator(LocalIndex cells) : blocks(cells), totals(cells) {}

    void finish_block(LocalIndex cell) {
        if constexpr (!Weighted) blocks[cell].weight = blocks[cell].count;
        totals[cell].absorb(blocks[cell]);
    }

    void start_block(LocalIndex cell, const std::array<double, Dimension>& position) {
        finish_block(cell);
        blocks[cell] = {};
        blocks[cell].origin = totals[cell].weight > 0 ? totals[cell].centroid() : position;
    }
};

template <bool Weighted, class Layout>
std::vector<Total<Layout::dimension>> accumulate(const Layout& x, const Points& points,
                                                 const SupportMesh& mesh) {
    constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);
    Accumulator<Weighted, dimension> accumulator(num_cells(mesh));
    std::array<std::int64_t, dimension> last;
    std::array<double, dimension> lower;
    for (std::size_t a = 0; a < dimension; ++a) {
        last[a] = mesh.cells[a] - 1;
        lower[a] = mesh.box.lower[a] * mesh.scale[a];
    }
    for (LocalIndex i = 0; i < points.count; ++i) {
        std::array<double, dimension> position;
        std::int64_t cell = 0;
        for (std::size_t a = dimension; a-- > 0;) {
            position[a] = x(i, static_cast<int>(a)) * mesh.scale[a];
            const auto layer =
                static_cast<std::int64_t>((position[a] - lower[a]) * mesh.cells_per_length[a]);
            cell = cell * (last[a] + 1) + std::min(layer, last[a]);
        }
        auto& block = accumulator.blocks[static_cast<LocalIndex>(cell)];
        if (block.count % block.length == 0)
            accumulator.start_block(static_cast<LocalIndex>(cell), position);
        const double weight = Weighted ? points.weights[i] : 1.0;
        ++block.count;
        if constexpr (Weighted) block.weight += weight;
        for (std::size_t a = 0; a < dimension; ++a) {
            const double difference = position[a] - block.origin[a];
            const double moment = Weighted ? weight * difference : difference;
            block.sum[a] += moment;
            block.square[a] += moment * difference;
        }
    }
    for (LocalIndex cell = 0; cell < accumulator.blocks.size(); ++cell)
        accumulator.finish_block(cell);
    return std::move(accumulator.totals);
}

bool any_weight(const Points& points) {
    return points.weights.empty() || std::any_of(points.weights.begin(), points.weights.end(),
                                                 [](double weight) { return weight > 0; });
}

template <std::size_t Dimension>
Moments finished(const Total<Dimension>& total, const SupportMesh& mesh) {
    Moments moments;
    moments.count = total.count;
    moments.weight = total.weight;
    const auto centroid = total.centroid();
    for (std::size_t a = 0; a < Dimension; ++a) {
        moments.mean[a] = centroid[a] / mesh.scale[a];
        moments.deviation[a] = std::sqrt(total.central[a] / total.weight) / mesh.scale[a];
    }
    return moments;
}

}  // namespace

Moments merge(const Moments& a, const Moments& b) {
    if (!(b.weight > 0)) return {a.count + b.count, a.weight, a.mean, a.deviation};
    if (!(a.weight > 0)) return {a.count + b.count, b.weight, b.mean, b.deviation};
    Moments joint{a.count + b.count, a.weight + b.weight, {}, {}};
    const double share_a = a.weight / joint.weight;
    const double share_b = b.weight / joint.weight;
    for (std::size_t axis = 0; axis < max_dimension; ++axis) {
        const double half_distance = b.mean[axis] / 2 - a.mean[axis] / 2;
        joint.mean[axis] = a.mean[axis] + 2 * (half_distance * share_b);
        joint.deviation[axis] = std::hypot(std::sqrt(share_a) * a.deviation[axis],
                                           std::sqrt(share_b) * b.deviation[axis],
                                           2 * std::sqrt(share_a * share_b) * half_distance);
    }
    return joint;
}

std::vector<CellMoments> cell_moments(const Points& points, const SupportMesh& mesh) {
    if (points.count == 0) return {};
    const bool weightless = !any_weight(points);
    const bool weighted = !points.weights.empty() && !weightless;
    return visit_layout(points, [&](const auto& x) {
        const auto totals =
            weighted ? accumulate<true>(x, points, mesh) : accumulate<false>(x, points, mesh);
        std::vector<CellMoments> cells;
        for (LocalIndex cell = 0; cell < totals.size(); ++cell) {
            if (!(totals[cell].weight > 0)) continue;
            cells.push_back({cell, cell_box(mesh, cell), finished(totals[cell], mesh)});
            if (weightless) cells.back().moments.weight = 0;
        }
        return cells;
    });
}

}  // namespace rrcb
