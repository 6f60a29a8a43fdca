#include <rrcb/moments.hpp>

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

/// Sums of w, w d and w d^2 over the points of a cell, d relative to `origin`, in scaled lengths.
template <std::size_t Dimension>
struct Sums {
    double weight = 0;
    std::array<double, Dimension> first{};
    std::array<double, Dimension> second{};

    Sums& operator+=(const Sums& other) {
        weight += other.weight;
        for (std::size_t a = 0; a < Dimension; ++a) {
            first[a] += other.first[a];
            second[a] += other.second[a];
        }
        return *this;
    }
};

struct Unweighted {
    double operator()(LocalIndex) const { return 1; }
};

struct Weighted {
    const double* weights;
    double operator()(LocalIndex i) const { return weights[i]; }
};

struct Scaled {
    const double* weights;
    double scale;
    double operator()(LocalIndex i) const { return weights[i] * scale; }
};

/// Power of two with which weights times squares of lengths neither overflow nor vanish.
double safe_scale(double heaviest) {
    constexpr int harmless_exponent = 200;
    const int exponent = std::ilogb(heaviest);
    if (std::abs(exponent) <= harmless_exponent) return 1;
    return std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
}

struct Entries {
    LocalIndex first;
    LocalIndex last;
};

/// Long ranges in halves: one running sum would lose a digit for every tenfold of the points.
template <std::size_t Dimension, class Weight>
Sums<Dimension> sum_about(const SortedPoints& points, Entries entries, const Weight& weight,
                          const std::array<double, Dimension>& origin) {
    constexpr LocalIndex most_at_once = 64;
    Sums<Dimension> sums;
    if (entries.last - entries.first > most_at_once) {
        const LocalIndex middle = entries.first + (entries.last - entries.first) / 2;
        sums = sum_about(points, {entries.first, middle}, weight, origin);
        return sums += sum_about(points, {middle, entries.last}, weight, origin);
    }
    const double* x = points.coordinates.data();
    for (LocalIndex i = entries.first; i < entries.last; ++i) {
        const double w = weight(i);
        sums.weight += w;
        for (std::size_t a = 0; a < Dimension; ++a) {
            const double d = x[i * Dimension + a] * points.mesh.scale[a] - origin[a];
            sums.first[a] += w * d;
            sums.second[a] += w * d * d;
        }
    }
    return sums;
}

template <std::size_t Dimension, class Weight>
Moments moments_of_cell(const SortedPoints& points, LocalIndex cell, const Weight& weight) {
    const Entries entries{points.first[cell], points.first[cell + 1]};
    Moments moments;
    moments.count = static_cast<GlobalCount>(entries.last - entries.first);
    const Vector& scale = points.mesh.scale;
    std::array<double, Dimension> origin;
    for (std::size_t a = 0; a < Dimension; ++a)
        origin[a] = points.coordinates[entries.first * Dimension + a] * scale[a];
    Sums<Dimension> sums = sum_about(points, entries, weight, origin);
    moments.weight = sums.weight;
    if (!(sums.weight > 0)) return moments;
    for (std::size_t a = 0; a < Dimension; ++a) origin[a] += sums.first[a] / sums.weight;
    sums = sum_about(points, entries, weight, origin);
    for (std::size_t a = 0; a < Dimension; ++a) {
        // `origin` is the mean rounded to a coordinate; what is left of it is taken off again.
        const double rest = sums.first[a] / sums.weight;
        moments.mean[a] = (origin[a] + rest) / scale[a];
        moments.deviation[a] =
            std::sqrt(std::max(0.0, sums.second[a] / sums.weight - rest * rest)) / scale[a];
    }
    return moments;
}

template <std::size_t Dimension, class Weight>
std::vector<CellMoments> moments_of_cells(const SortedPoints& points, const Weight& weight) {
    std::vector<CellMoments> cells;
    for (LocalIndex cell = 0; cell + 1 < points.first.size(); ++cell) {
        if (points.first[cell] == points.first[cell + 1]) continue;
        const Moments moments = moments_of_cell<Dimension>(points, cell, weight);
        if (moments.weight > 0) cells.push_back({cell, cell_box(points.mesh, cell), moments});
    }
    return cells;
}

template <std::size_t Dimension>
std::vector<CellMoments> moments_by_weight(const SortedPoints& points) {
    if (points.weights.empty()) return moments_of_cells<Dimension>(points, Unweighted{});
    const double heaviest = *std::max_element(points.weights.begin(), points.weights.end());
    if (!(heaviest > 0)) {
        auto cells = moments_of_cells<Dimension>(points, Unweighted{});
        for (CellMoments& cell : cells) cell.moments.weight = 0;
        return cells;
    }
    const double scale = safe_scale(heaviest);
    if (scale == 1) return moments_of_cells<Dimension>(points, Weighted{points.weights.data()});
    auto cells = moments_of_cells<Dimension>(points, Scaled{points.weights.data(), scale});
    for (CellMoments& cell : cells) cell.moments.weight /= scale;
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

std::vector<CellMoments> cell_moments(const SortedPoints& points) {
    if (points.dimension() == 1) return moments_by_weight<1>(points);
    return points.dimension() == 2 ? moments_by_weight<2>(points) : moments_by_weight<3>(points);
}

std::vector<CellMoments> cell_moments(const Points& points, const SupportMesh& mesh) {
    return cell_moments(sort_by_cell(points, mesh));
}

}  // namespace rrcb
