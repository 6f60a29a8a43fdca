#include "arithmetic/running_sums.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"
#include "passes/binned_points.hpp"
#include "passes/cell_finder.hpp"

#include <rrcb/method/moments.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rrcb {

namespace {

/// Origins of the cells, and the sums about them.
template <std::size_t Dimension>
struct Centred {
    std::vector<std::array<double, Dimension>> origins;
    std::vector<MomentSums<Dimension>> sums;
};

template <std::size_t Dimension>
Centred<Dimension> sums_about_first_points(const BinnedPoints& binned) {
    const std::size_t num_cells = binned.counts.size();
    Centred<Dimension> result{decltype(result.origins)(num_cells),
                              decltype(result.sums)(num_cells)};
    for (std::size_t cell = 0; cell < num_cells; ++cell) {
        std::copy_n(&binned.origins[cell * Dimension], Dimension, result.origins[cell].begin());
        std::copy_n(&binned.first_moments[cell * Dimension], Dimension,
                    result.sums[cell].first.begin());
        std::copy_n(&binned.second_moments[cell * Dimension], Dimension,
                    result.sums[cell].second.begin());
    }
    return result;
}

/// Returns true if an origin is too far from the mean. The variance is the mean of the squares less
/// the square of that distance; it would lose more than a digit.
bool is_far_off(double first, double second, double weight) {
    constexpr double most_variances = 16;
    const double rest = first / weight;
    return rest * rest * (most_variances + 1) > second / weight * most_variances;
}

/// Moves far-off origins to the mean. Only a first point that is an outlier among many is so far
/// off: of n points of equal weight none is more than sqrt(n) standard deviations from the mean.
template <std::size_t Dimension>
bool move_origins(const BinnedPoints& binned, Centred<Dimension>& cells) {
    bool moved = false;
    for (std::size_t cell = 0; cell < cells.sums.size(); ++cell) {
        const double weight = binned.scaled_weight(cell);
        if (!(weight > 0)) continue;
        for (std::size_t a = 0; a < Dimension; ++a) {
            const MomentSums<Dimension>& sums = cells.sums[cell];
            if (!is_far_off(sums.first[a], sums.second[a], weight)) continue;
            cells.origins[cell][a] += sums.first[a] / weight;
            moved = true;
        }
    }
    return moved;
}

struct Unweighted {
    double operator()(LocalIndex) const { return 1; }
};

struct Weighted {
    const double* weights;
    double scale;
    double operator()(LocalIndex i) const { return weights[i] * scale; }
};

/// Sums every cell up again, about its new origin.
template <class Layout, class Weight>
void sum_again(const Layout& x, const BinnedPoints& binned, const Weight& weight,
               Centred<static_cast<std::size_t>(Layout::dimension)>& cells) {
    constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);
    std::array<double, dimension> scale;
    std::copy_n(binned.mesh.scale.begin(), dimension, scale.begin());
    RunningSums<MomentSums<dimension>> sums(cells.origins.size());
    const CellFinder finder(binned.mesh);
    in_ranges(binned.points.count, sums.interval(), [&](LocalIndex begin, LocalIndex end) {
        visit_cells(finder, x, begin, end, [&](LocalIndex i, std::size_t cell) {
            const std::array<double, dimension>& origin = cells.origins[cell];
            MomentSums<dimension>& sum = sums[cell];
            const double w = weight(i);
            for (std::size_t a = 0; a < dimension; ++a) {
                const double d = x(i, static_cast<int>(a)) * scale[a] - origin[a];
                sum.first[a] += w * d;
                sum.second[a] += w * d * d;
            }
        });
        sums.empty();
    });
    cells.sums = sums.totals();
}

template <std::size_t Dimension>
CellMoments moments_of(const BinnedPoints& binned, LocalIndex cell,
                       const std::array<double, Dimension>& origin,
                       const MomentSums<Dimension>& sums) {
    const Vector& scale = binned.mesh.scale;
    const double weight = binned.scaled_weight(cell);
    CellMoments result{cell, cell_box(binned.mesh, cell), {}};
    result.moments.count = static_cast<GlobalCount>(binned.counts[cell]);
    result.moments.weight = weight / binned.weight_scale;
    for (std::size_t a = 0; a < Dimension; ++a) {
        // No more than a digit is lost: see is_far_off.
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
    Centred<dimension> centred = sums_about_first_points<dimension>(binned);
    if (move_origins(binned, centred)) sum_again(x, binned, weight, centred);
    std::vector<CellMoments> cells;
    for (LocalIndex cell = 0; cell < binned.counts.size(); ++cell)
        if (binned.scaled_weight(cell) > 0)
            cells.push_back(moments_of(binned, cell, centred.origins[cell], centred.sums[cell]));
    return cells;
}

/// Returns the mean of two groups, from the mean and the share of each; between `a` and `b`
/// whatever the rounding.
double joint_mean(double a, double share_a, double b, double share_b) {
    // With opposite signs the difference may overflow; with the same sign it is exact enough.
    const double mean =
        std::signbit(a) != std::signbit(b) ? share_a * a + share_b * b : a + share_b * (b - a);
    return std::clamp(mean, std::min(a, b), std::max(a, b));
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
        joint.mean[axis] = joint_mean(a.mean[axis], share_a, b.mean[axis], share_b);
        const double deviation = std::hypot(std::sqrt(share_a) * a.deviation[axis],
                                            std::sqrt(share_b) * b.deviation[axis],
                                            2 * std::sqrt(share_a * share_b) * half_distance);
        // Rounding may lead beyond the largest double.
        joint.deviation[axis] = std::min(deviation, std::numeric_limits<double>::max());
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
    check_arrays(points);
    require(points.dimension == mesh.dimension, "the mesh must have the dimension of the points");
    return locally([&] { return cell_moments(bin_by_cell(points, mesh)); });
}

}  // namespace rrcb
