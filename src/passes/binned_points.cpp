#include "passes/binned_points.hpp"

#include "arithmetic/running_sums.hpp"
#include "arithmetic/safe_scale.hpp"
#include "passes/cell_finder.hpp"

#include <algorithm>

namespace rrcb {

namespace {

/// Sum of the weights of one cell, if points have weights.
template <bool Weighted>
struct WeightSum {
    double sum = 0;
};
template <>
struct WeightSum<false> {};

/// Sums over the points of one cell.
template <std::size_t Dimension, bool Weighted>
struct CellSum : MomentSums<Dimension> {
    [[no_unique_address]] WeightSum<Weighted> weight{};

    CellSum& operator+=(const CellSum& other) {
        MomentSums<Dimension>::operator+=(other);
        if constexpr (Weighted) weight.sum += other.weight.sum;
        return *this;
    }
};

/// A cell while points are added: 64 bytes in 2-D, a size that is cheap to multiply by.
template <std::size_t Dimension, bool Weighted>
struct alignas(2 * sizeof(double)) RunningCell : CellSum<Dimension, Weighted> {
    std::array<double, Dimension> origin{};  ///< its first point
    LocalIndex num_others = -1;              ///< number of its points, less one
};

/// Finds the cells of a block of points by vectors, and adds the block up while it is in the cache.
template <class Layout, bool Weighted>
class Binner {
    static constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);
    using Position = std::array<double, dimension>;

  public:
    Binner(const Layout& x, BinnedPoints& binned)
        : x_(x), binned_(binned), finder_(binned.mesh), sums_(num_cells(binned.mesh)) {
        std::copy_n(binned.mesh.scale.begin(), dimension, scale_.begin());
    }

    void run() {
        const auto add = adder();
        in_ranges(binned_.points.count, sums_.interval(), [&](LocalIndex first, LocalIndex last) {
            visit_cells(finder_, x_, first, last, add);
            sums_.empty();
        });
        write_totals();
    }

  private:
    /// Returns a function that adds point `i` to its cell. It captures copies, so that the compiler
    /// knows that nothing overlaps the sums.
    auto adder() {
        return [points = x_, scale = scale_, cells = &sums_[0],
                weights = binned_.points.weights.data(),
                weight_scale = binned_.weight_scale](LocalIndex i, std::size_t number) {
            static_cast<void>(weight_scale);  // unused without weights, which Clang reports
            RunningCell<dimension, Weighted>& cell = cells[number];
            Position x;
            for (std::size_t a = 0; a < dimension; ++a)
                x[a] = points(i, static_cast<int>(a)) * scale[a];
            if (++cell.num_others == 0) cell.origin = x;
            // Copies, and one loop for each sum: otherwise the loops would not be vectorized.
            for (std::size_t a = 0; a < dimension; ++a) x[a] -= cell.origin[a];
            Position moment = x;
            [[maybe_unused]] const double weight = Weighted ? weights[i] * weight_scale : 1;
            if constexpr (Weighted) {
                cell.weight.sum += weight;
                for (double& value : moment) value *= weight;
            }
            for (std::size_t a = 0; a < dimension; ++a) cell.first[a] += moment[a];
            for (std::size_t a = 0; a < dimension; ++a) cell.second[a] += moment[a] * x[a];
        };
    }

    void write_totals() {
        const auto append = [](std::vector<double>& to, const Position& values) {
            to.insert(to.end(), values.begin(), values.end());
        };
        const auto& totals = sums_.totals();
        if constexpr (Weighted) binned_.weights.reserve(totals.size());
        for (auto* sums : {&binned_.first_moments, &binned_.second_moments, &binned_.origins})
            sums->reserve(dimension * totals.size());
        binned_.counts.reserve(totals.size());
        for (std::size_t cell = 0; cell < totals.size(); ++cell) {
            if constexpr (Weighted) binned_.weights.push_back(totals[cell].weight.sum);
            append(binned_.first_moments, totals[cell].first);
            append(binned_.second_moments, totals[cell].second);
            append(binned_.origins, sums_[cell].origin);
            binned_.counts.push_back(sums_[cell].num_others + 1);
        }
    }

    Layout x_;
    BinnedPoints& binned_;
    CellFinder finder_;
    Position scale_;
    RunningSums<CellSum<dimension, Weighted>, RunningCell<dimension, Weighted>> sums_;
};

/// Returns a power of two that keeps weights times squared lengths in range.
double scale_of_weights(std::span<const double> weights) {
    constexpr int harmless_exponent = 200;
    return safe_scale(weights.empty() ? 0 : std::ranges::max(weights), harmless_exponent);
}

}  // namespace

BinnedPoints bin_by_cell(const Points& points, const SupportMesh& mesh) {
    BinnedPoints binned;
    binned.mesh = mesh;
    binned.points = points;
    binned.weight_scale = scale_of_weights(points.weights);
    visit_layout(points, [&]<class Layout>(const Layout& x) {
        if (points.weights.empty()) {
            Binner<Layout, false>(x, binned).run();
        } else {
            Binner<Layout, true>(x, binned).run();
        }
    });
    return binned;
}

}  // namespace rrcb
