#include "lane_sums.hpp"
#include "point_layout.hpp"

#include <rrcb/moments.hpp>

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

/// Sums of w d and w d^2 over points, d relative to the centroid of their cell as far as it is
/// known, in scaled lengths.
template <std::size_t Dimension>
struct Sums {
    std::array<double, Dimension> first{};
    std::array<double, Dimension> second{};

    Sums& operator+=(const Sums& other) {
        for (std::size_t a = 0; a < Dimension; ++a) {
            first[a] += other.first[a];
            second[a] += other.second[a];
        }
        return *this;
    }
};

template <std::size_t Dimension>
using Positions = std::vector<std::array<double, Dimension>>;

/// Centroid of every cell that holds weight, in scaled lengths, to the round-off of the mesh.
template <std::size_t Dimension>
Positions<Dimension> centroids(const BinnedPoints& binned) {
    const SupportMesh& mesh = binned.mesh;
    Positions<Dimension> result(binned.counts.size());
    for (LocalIndex cell = 0; cell < result.size(); ++cell) {
        const double weight = binned.scaled_weight(cell);
        if (!(weight > 0)) continue;
        LocalIndex rest = cell;
        for (std::size_t a = 0; a < Dimension; ++a) {
            const auto cells = static_cast<LocalIndex>(mesh.cells[a]);
            const double offset =
                static_cast<double>(rest % cells) + binned.offsets[cell * Dimension + a] / weight;
            rest /= cells;
            result[cell][a] = mesh.box.lower[a] * mesh.scale[a];
            if (mesh.cells_per_length[a] > 0) result[cell][a] += offset / mesh.cells_per_length[a];
        }
    }
    return result;
}

struct Unweighted {
    double operator()(LocalIndex) const { return 1; }
};

struct Weighted {
    const double* weights;
    double scale;
    double operator()(LocalIndex i) const { return weights[i] * scale; }
};

/// The sums of every cell about its `origins`.
template <class Layout, class Weight>
auto sums_about(const Positions<static_cast<std::size_t>(Layout::dimension)>& origins,
                const Layout& x, const BinnedPoints& binned, const Weight& weight) {
    constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);
    std::array<double, dimension> scale;
    std::copy_n(binned.mesh.scale.begin(), dimension, scale.begin());
    LaneSums<Sums<dimension>> sums(origins.size());
    in_ranges(binned.points.count, sums.interval(), [&](LocalIndex begin, LocalIndex end) {
        for (LocalIndex i = begin; i < end; ++i) {
            const std::size_t cell = binned.cells[i];
            const std::array<double, dimension>& origin = origins[cell];
            Sums<dimension>& sum = sums.of(cell, i);
            const double w = weight(i);
            for (std::size_t a = 0; a < dimension; ++a) {
                const double d = x(i, static_cast<int>(a)) * scale[a] - origin[a];
                sum.first[a] += w * d;
                sum.second[a] += w * d * d;
            }
        }
        sums.empty_lanes();
    });
    return sums.totals();
}

template <std::size_t Dimension>
CellMoments moments_of(const BinnedPoints& binned, LocalIndex cell,
                       const std::array<double, Dimension>& origin, const Sums<Dimension>& sums) {
    const Vector& scale = binned.mesh.scale;
    const double weight = binned.scaled_weight(cell);
    CellMoments result{cell, cell_box(binned.mesh, cell), {}};
    result.moments.count = static_cast<GlobalCount>(binned.counts[cell]);
    result.moments.weight = weight / binned.weight_scale;
    for (std::size_t a = 0; a < Dimension; ++a) {
        // `origin` is the mean rounded to a coordinate; what is left of it is taken off again.
        const double rest = sums.first[a] / weight;
        result.moments.mean[a] = (origin[a] + rest) / scale[a];
        result.moments.deviation[a] =
            std::sqrt(std::max(0.0, sums.second[a] / weight - rest * rest)) / scale[a];
    }
    return result;
}

template <class Layout, class Weight>
std::vector<CellMoments> moments_of_cells(const Layout& x, const BinnedPoints& binned,
                                          const Weight& weight) {
    constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);
    const Positions<dimension> origins = centroids<dimension>(binned);
    const auto sums = sums_about(origins, x, binned, weight);
    std::vector<CellMoments> cells;
    for (LocalIndex cell = 0; cell < binned.counts.size(); ++cell)
        if (binned.scaled_weight(cell) > 0)
            cells.push_back(moments_of(binned, cell, origins[cell], sums[cell]));
    return cells;
}

}  // namespace

Moments merge(const Moments& a, const Moments& b) {
    if (a.weight == 0 && b.weight == 0 && a.count > 0 && b.count > 0) {
        Moments joint = merge({a.count, static_cast<double>(a.count), a.mean, a.deviation},
                              {b.count, static_cast<double>(b.count), b.mean, b.deviation});
        joint.weight = 0;
        return joint;
    }
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

std::vector<CellMoments> cell_moments(const BinnedPoints& binned) {
    const Points& points = binned.points;
    const bool weightless =
        !points.weights.empty() &&
        std::ranges::none_of(binned.weights, [](double weight) { return weight > 0; });
    if (weightless) {
        Points unweighted = points;
        unweighted.weights = {};
        auto cells = cell_moments(bin_by_cell(unweighted, binned.mesh));
        for (CellMoments& cell : cells) cell.moments.weight = 0;
        return cells;
    }
    return visit_layout(points, [&](const auto& x) {
        return points.weights.empty()
                   ? moments_of_cells(x, binned, Unweighted{})
                   : moments_of_cells(x, binned,
                                      Weighted{points.weights.data(), binned.weight_scale});
    });
}

std::vector<CellMoments> cell_moments(const Points& points, const SupportMesh& mesh) {
    return cell_moments(bin_by_cell(points, mesh));
}

}  // namespace rrcb
