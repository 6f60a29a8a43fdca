#include "lane_sums.hpp"
#include "point_layout.hpp"

#include <rrcb/binned_points.hpp>

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

constexpr std::size_t block_length = 256;

/// What the points of one cell add up to.
template <std::size_t Dimension, bool Weighted>
struct CellSum {
    std::array<double, Dimension> offset{};
    LocalIndex count = 0;
    std::array<double, Weighted ? 1 : 0> weight{};

    CellSum& operator+=(const CellSum& other) {
        for (std::size_t a = 0; a < Dimension; ++a) offset[a] += other.offset[a];
        count += other.count;
        if constexpr (Weighted) weight[0] += other.weight[0];
        return *this;
    }
};

/// Cells of consecutive points, and how far into its cell each point lies, in cells.
template <std::size_t Dimension>
struct Block {
    std::array<std::int32_t, Dimension * block_length> layers;
    std::array<double, Dimension * block_length> offsets;
};

/// Finds the cells block by block, as vectors, and adds each block up while it is in the cache.
template <class Layout, bool Weighted>
class Binner {
    static constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);

  public:
    Binner(const Layout& x, BinnedPoints& binned)
        : x_(x), binned_(binned), sums_(num_cells(binned.mesh)) {
        const SupportMesh& mesh = binned.mesh;
        for (std::size_t a = 0; a < dimension; ++a) {
            scale_[a] = mesh.scale[a];
            lower_[a] = mesh.box.lower[a] * mesh.scale[a];
            cells_per_length_[a] = mesh.cells_per_length[a];
            cells_[a] = mesh.cells[a];
        }
    }

    void run() {
        in_ranges(binned_.points.count, sums_.interval(), [&](LocalIndex first, LocalIndex last) {
            in_ranges(last - first, block_length, [&](LocalIndex begin, LocalIndex end) {
                locate(first + begin, end - begin);
                add(first + begin, end - begin);
            });
            sums_.empty_lanes();
        });
        write_totals();
    }

  private:
    void locate(LocalIndex first, LocalIndex length) {
        for (LocalIndex i = 0; i < length; ++i) {
            for (std::size_t a = 0; a < dimension; ++a) {
                const double x = x_(first + i, static_cast<int>(a));
                block_.offsets[i * dimension + a] =
                    (x * scale_[a] - lower_[a]) * cells_per_length_[a];
            }
        }
        for (std::size_t k = 0; k < length * dimension; ++k)
            block_.layers[k] = static_cast<std::int32_t>(block_.offsets[k]);
        for (LocalIndex i = 0; i < length; ++i) {
            for (std::size_t a = 0; a < dimension; ++a) {
                // The upper face of the box belongs to the last layer.
                std::int32_t& layer = block_.layers[i * dimension + a];
                layer -= layer == cells_[a] ? 1 : 0;
            }
        }
        for (std::size_t k = 0; k < length * dimension; ++k) block_.offsets[k] -= block_.layers[k];
    }

    void add(LocalIndex first, LocalIndex length) {
        for (LocalIndex i = 0; i < length; ++i) {
            std::int32_t cell = 0;
            for (std::size_t a = dimension; a-- > 0;)
                cell = cell * cells_[a] + block_.layers[i * dimension + a];
            binned_.cells[first + i] = static_cast<std::uint32_t>(cell);
            CellSum<dimension, Weighted>& sum = sums_.of(static_cast<std::size_t>(cell), i);
            const double* offset = &block_.offsets[i * dimension];
            ++sum.count;
            if constexpr (Weighted) {
                const double weight = binned_.points.weights[first + i] * binned_.weight_scale;
                sum.weight[0] += weight;
                for (std::size_t a = 0; a < dimension; ++a) sum.offset[a] += weight * offset[a];
            } else {
                for (std::size_t a = 0; a < dimension; ++a) sum.offset[a] += offset[a];
            }
        }
    }

    void write_totals() {
        for (const CellSum<dimension, Weighted>& sum : sums_.totals()) {
            binned_.counts.push_back(sum.count);
            binned_.offsets.insert(binned_.offsets.end(), sum.offset.begin(), sum.offset.end());
            binned_.weights.insert(binned_.weights.end(), sum.weight.begin(), sum.weight.end());
        }
    }

    Layout x_;
    BinnedPoints& binned_;
    std::array<double, dimension> scale_;
    std::array<double, dimension> lower_;
    std::array<double, dimension> cells_per_length_;
    std::array<std::int32_t, dimension> cells_;
    LaneSums<CellSum<dimension, Weighted>> sums_;
    Block<dimension> block_;
};

/// Power of two with which weights times squares of lengths neither overflow nor vanish.
double safe_scale(std::span<const double> weights) {
    constexpr int harmless_exponent = 200;
    const double heaviest = weights.empty() ? 0 : std::ranges::max(weights);
    if (!(heaviest > 0)) return 1;
    const int exponent = std::ilogb(heaviest);
    if (std::abs(exponent) <= harmless_exponent) return 1;
    return std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
}

}  // namespace

BinnedPoints bin_by_cell(const Points& points, const SupportMesh& mesh) {
    BinnedPoints binned;
    binned.mesh = mesh;
    binned.points = points;
    binned.cells.resize(points.count);
    binned.weight_scale = safe_scale(points.weights);
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
