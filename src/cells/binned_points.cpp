#include "cells/binned_points.hpp"

#include "cells/point_layout.hpp"
#include "cells/running_sums.hpp"
#include "cells/safe_scale.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

constexpr std::size_t block_length = 256;

/// Sums over the points of one cell.
template <std::size_t Dimension, bool Weighted>
struct CellSum {
    std::array<double, Dimension> first{};
    std::array<double, Dimension> second{};
    LocalIndex count = 0;
    [[no_unique_address]] std::array<double, Weighted ? 1 : 0> weight{};

    CellSum& operator+=(const CellSum& other) {
        for (std::size_t a = 0; a < Dimension; ++a) first[a] += other.first[a];
        for (std::size_t a = 0; a < Dimension; ++a) second[a] += other.second[a];
        count += other.count;
        if constexpr (Weighted) weight[0] += other.weight[0];
        return *this;
    }
};

/// Finds the cells block by block, as vectors, and adds each block up while it is in the cache.
template <class Layout, bool Weighted>
class Binner {
    static constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);
    using Position = std::array<double, dimension>;

  public:
    Binner(const Layout& x, BinnedPoints& binned)
        : x_(x),
          binned_(binned),
          sums_(num_cells(binned.mesh)),
          origins_(num_cells(binned.mesh)),
          seen_(num_cells(binned.mesh)) {
        const SupportMesh& mesh = binned.mesh;
        for (std::size_t a = 0; a < dimension; ++a) {
            scale_[a] = mesh.scale[a];
            lower_[a] = mesh.box.lower[a] * mesh.scale[a];
            cells_per_length_[a] = mesh.cells_per_length[a];
            cells_[a] = static_cast<std::uint32_t>(mesh.cells[a]);
            cells_below_[a] = std::nextafter(mesh.cells[a], 0);
        }
    }

    void run() {
        in_ranges(binned_.points.count, sums_.interval(), [&](LocalIndex first, LocalIndex last) {
            in_ranges(last - first, block_length, [&](LocalIndex begin, LocalIndex end) {
                locate(first + begin, end - begin);
                for (LocalIndex i = 0; i < end - begin; ++i) add(first + begin, i);
            });
            sums_.empty();
        });
        write_totals();
    }

  private:
    void locate(LocalIndex first, LocalIndex length) {
        for (LocalIndex i = 0; i < length; ++i) {
            for (std::size_t a = 0; a < dimension; ++a) {
                const double x = x_(first + i, static_cast<int>(a)) * scale_[a];
                const double offset = (x - lower_[a]) * cells_per_length_[a];
                // The upper face of the box belongs to the last layer.
                const double layer = offset < cells_below_[a] ? offset : cells_below_[a];
                layers_[i * dimension + a] =
                    static_cast<std::uint32_t>(static_cast<std::int32_t>(layer));
            }
        }
    }

    std::uint32_t cell_of_entry(LocalIndex i) const {
        std::uint32_t cell = 0;
        for (std::size_t a = dimension; a-- > 0;)
            cell = cell * cells_[a] + layers_[i * dimension + a];
        return cell;
    }

    /// Adds entry `i` of the block at `first` to the sums of its cell.
    void add(LocalIndex first, LocalIndex i) {
        const std::uint32_t cell = cell_of_entry(i);
        binned_.cells[first + i] = cell;
        Position x;
        for (std::size_t a = 0; a < dimension; ++a)
            x[a] = x_(first + i, static_cast<int>(a)) * scale_[a];
        if (!seen_[cell]) {
            seen_[cell] = true;
            origins_[cell] = x;
        }
        // Copies, and one loop for each sum: else they might overlap, and could not be vectors.
        const Position origin = origins_[cell];
        CellSum<dimension, Weighted>& sum = sums_[cell];
        ++sum.count;
        for (std::size_t a = 0; a < dimension; ++a) x[a] -= origin[a];
        Position moment = x;
        if constexpr (Weighted) {
            const double weight = binned_.points.weights[first + i] * binned_.weight_scale;
            sum.weight[0] += weight;
            for (double& value : moment) value *= weight;
        }
        for (std::size_t a = 0; a < dimension; ++a) sum.first[a] += moment[a];
        for (std::size_t a = 0; a < dimension; ++a) sum.second[a] += moment[a] * x[a];
    }

    void write_totals() {
        for (const CellSum<dimension, Weighted>& sum : sums_.totals()) {
            binned_.counts.push_back(sum.count);
            binned_.weights.insert(binned_.weights.end(), sum.weight.begin(), sum.weight.end());
            binned_.first_moments.insert(binned_.first_moments.end(), sum.first.begin(),
                                         sum.first.end());
            binned_.second_moments.insert(binned_.second_moments.end(), sum.second.begin(),
                                          sum.second.end());
        }
        for (const Position& origin : origins_)
            binned_.origins.insert(binned_.origins.end(), origin.begin(), origin.end());
    }

    Layout x_;
    BinnedPoints& binned_;
    Position scale_;
    Position lower_;
    Position cells_per_length_;
    std::array<std::uint32_t, dimension> cells_;
    Position cells_below_;  ///< the number before it
    RunningSums<CellSum<dimension, Weighted>> sums_;
    std::vector<Position> origins_;
    std::vector<char> seen_;
    std::array<std::uint32_t, dimension * block_length> layers_;  ///< of the points of a block
};

/// Power of two with which weights times squares of lengths neither overflow nor vanish.
double scale_of_weights(std::span<const double> weights) {
    constexpr int harmless_exponent = 200;
    return safe_scale(weights.empty() ? 0 : std::ranges::max(weights), harmless_exponent);
}

}  // namespace

BinnedPoints bin_by_cell(const Points& points, const SupportMesh& mesh) {
    BinnedPoints binned;
    binned.mesh = mesh;
    binned.points = points;
    binned.cells.resize(points.count);
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
