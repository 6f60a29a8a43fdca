#include "arithmetic/running_sums.hpp"
#include "arithmetic/safe_scale.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"
#include "passes/cell_finder.hpp"
#include "passes/host_passes.hpp"

#include <rrcb/detail/moments.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rrcb {

namespace {

/// Sums over the points of one cell. d is the position relative to the origin of the cell, in
/// scaled lengths; w is the weight.
template <std::size_t Dimension, bool Weighted>
struct CellSum {
    std::array<double, Dimension> first{};   ///< sum of w d
    std::array<double, Dimension> second{};  ///< sum of w d^2
    /// sum of w, if points have weights
    [[no_unique_address]] std::array<double, Weighted ? 1 : 0> weight{};

    CellSum& operator+=(const CellSum& other) {
        for (std::size_t a = 0; a < Dimension; ++a) first[a] += other.first[a];
        for (std::size_t a = 0; a < Dimension; ++a) second[a] += other.second[a];
        if constexpr (Weighted) weight[0] += other.weight[0];
        return *this;
    }
};

/// A cell while points are added. It has 64 bytes in 2-D, a size by which an index is cheaply
/// multiplied.
template <std::size_t Dimension, bool Weighted>
struct alignas(2 * sizeof(double)) RunningCell : CellSum<Dimension, Weighted> {
    std::array<double, Dimension> origin{};  ///< its first point, unless move_origins() has set
                                             ///< another
    LocalIndex num_others = -1;              ///< number of its points minus 1
};

/// Returns true if an origin is too far from the mean. The variance is the mean of the squares
/// minus the square of this distance, so it would lose more than a digit.
bool is_far_off(double first, double second, double weight) {
    constexpr double most_variances = 16;
    const double rest = first / weight;
    return rest * rest * (most_variances + 1) > second / weight * most_variances;
}

/// Returns a power of two that keeps weights times squared lengths within the range of doubles.
double scale_of_weights(std::span<const double> weights) {
    constexpr int harmless_exponent = 200;
    return safe_scale(weights.empty() ? 0 : std::ranges::max(weights), harmless_exponent);
}

/// Finds the cells of a block of points by vector instructions, and adds up the block while it is
/// in the cache.
template <class Layout, bool Weighted>
class Binner {
    static constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);
    using Position = std::array<double, dimension>;
    using Sum = CellSum<dimension, Weighted>;
    using Running = RunningCell<dimension, Weighted>;

  public:
    Binner(const Layout& x, const Points& points, const SupportMesh& mesh)
        : x_(x),
          points_(points),
          mesh_(mesh),
          weight_scale_(scale_of_weights(points.weights)),
          sums_(num_cells(mesh)) {
        std::copy_n(mesh.scale.begin(), dimension, scale_.begin());
    }

    std::vector<CellMoments> run() {
        add_up();
        if (move_origins()) add_up();
        std::vector<CellMoments> cells;
        for (LocalIndex cell = 0; cell < sums_.totals().size(); ++cell)
            if (weight_of(cell) > 0) cells.push_back(moments_of(cell));
        return cells;
    }

  private:
    void add_up() {
        const auto add = adder();
        const CellFinder finder(mesh_);
        in_ranges(points_.count, sums_.interval(), [&](LocalIndex first, LocalIndex last) {
            visit_cells(finder, x_, first, last, add);
            sums_.empty();
        });
    }

    /// Returns a function that adds point `i` to its cell. It captures copies, so that the compiler
    /// knows that nothing overlaps the sums.
    auto adder() {
        return [points = x_, scale = scale_, cells = &sums_[0], weights = points_.weights.data(),
                weight_scale = weight_scale_](LocalIndex i, std::size_t number) {
            static_cast<void>(weight_scale);  // unused without weights, which Clang reports
            Running& cell = cells[number];
            Position x;
            for (std::size_t a = 0; a < dimension; ++a)
                x[a] = points(i, static_cast<int>(a)) * scale[a];
            if (++cell.num_others == 0) cell.origin = x;
            // Copies the position and has one loop for each sum, because otherwise the loops would
            // not be vectorized.
            for (std::size_t a = 0; a < dimension; ++a) x[a] -= cell.origin[a];
            Position moment = x;
            [[maybe_unused]] const double weight = Weighted ? weights[i] * weight_scale : 1;
            if constexpr (Weighted) {
                cell.weight[0] += weight;
                for (double& value : moment) value *= weight;
            }
            for (std::size_t a = 0; a < dimension; ++a) cell.first[a] += moment[a];
            for (std::size_t a = 0; a < dimension; ++a) cell.second[a] += moment[a] * x[a];
        };
    }

    LocalIndex count_of(LocalIndex cell) { return sums_[cell].num_others + num_origins_; }

    /// Returns the scaled weight of a cell.
    double weight_of(LocalIndex cell) {
        if constexpr (Weighted)
            return sums_.totals()[cell].weight[0];
        else
            return static_cast<double>(count_of(cell));
    }

    /// Moves origins that are too far off to the mean, and resets their sums. Returns false if
    /// there are none. An origin is so far off only if the first point is an outlier among many: of
    /// n points of equal weight, none is more than sqrt(n) standard deviations from the mean.
    bool move_origins() {
        RunningSums<Sum, Running> moved(sums_.totals().size());
        bool is_moved = false;
        for (LocalIndex cell = 0; cell < sums_.totals().size(); ++cell) {
            const Sum& sum = sums_.totals()[cell];
            const double weight = weight_of(cell);
            moved[cell].origin = sums_[cell].origin;
            moved[cell].num_others = 0;
            for (std::size_t a = 0; a < dimension; ++a) {
                if (!(weight > 0) || !is_far_off(sum.first[a], sum.second[a], weight)) continue;
                moved[cell].origin[a] += sum.first[a] / weight;
                is_moved = true;
            }
        }
        if (!is_moved) return false;
        sums_ = std::move(moved);
        num_origins_ = 0;
        return true;
    }

    CellMoments moments_of(LocalIndex cell) {
        const Sum& sum = sums_.totals()[cell];
        const double weight = weight_of(cell);
        CellMoments result{cell, cell_box(mesh_, cell), {}};
        result.moments.count = static_cast<GlobalCount>(count_of(cell));
        result.moments.weight = weight / weight_scale_;
        for (std::size_t a = 0; a < dimension; ++a) {
            // This loses no more than a digit; see is_far_off().
            const double rest = sum.first[a] / weight;
            result.moments.mean[a] = (sums_[cell].origin[a] + rest) / scale_[a];
            result.moments.deviation[a] =
                std::sqrt(std::max(0.0, sum.second[a] / weight - rest * rest)) / scale_[a];
        }
        return result;
    }

    Layout x_;
    const Points& points_;
    const SupportMesh& mesh_;
    double weight_scale_;
    Position scale_{};
    RunningSums<Sum, Running> sums_;
    LocalIndex num_origins_ = 1;  ///< number of points of a cell that are at its origin
};

/// Returns the moments of cells as cell_moments(), without checking the points. Reads the points
/// once, or twice if the first point of a cell is far off.
std::vector<CellMoments> moments_of_cells(const Points& points, const SupportMesh& mesh) {
    auto cells = visit_layout(points, [&]<class Layout>(const Layout& x) {
        return points.weights.empty() ? Binner<Layout, false>(x, points, mesh).run()
                                      : Binner<Layout, true>(x, points, mesh).run();
    });
    if (!cells.empty() || points.weights.empty()) return cells;
    Points unweighted = points;
    unweighted.weights = {};
    cells = moments_of_cells(unweighted, mesh);
    for (CellMoments& cell : cells) cell.moments.weight = 0;
    return cells;
}

/// Returns the mean of two groups from the mean and the share of each. The result is between `a`
/// and `b` in spite of rounding.
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
        // Rounding may exceed the largest double.
        joint.deviation[axis] = std::min(deviation, std::numeric_limits<double>::max());
    }
    return joint;
}

std::vector<CellMoments> HostPasses::moments(const SupportMesh& mesh) {
    return moments_of_cells(points_, mesh);
}

std::vector<CellMoments> cell_moments(const Points& points, const SupportMesh& mesh) {
    check_arrays(points);
    require(points.dimension == mesh.dimension, "the mesh must have the dimension of the points");
    return locally([&] { return moments_of_cells(points, mesh); });
}

}  // namespace rrcb
