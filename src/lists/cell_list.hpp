#pragma once

#include <rrcb/points.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace rrcb {

/// Points of a rank in about as many cells of their box, to find those near a position.
class CellList {
  public:
    /// Throws std::bad_alloc. Coordinates are finite.
    explicit CellList(const Points& points)
        : box_(bounding_box(points)), dimension_(points.dimension) {
        const double along_axis = std::pow(static_cast<double>(points.count), 1. / dimension_);
        for (int a = 0; a < dimension_; ++a)
            num_cells_[a] = std::max(1, static_cast<int>(along_axis));
        cells_.reserve(points.count);
        for (LocalIndex i = 0; i < points.count; ++i)
            cells_.emplace_back(key_of(cell_of(points.position(i))), i);
        std::ranges::sort(cells_);
    }

    /// Calls visit(point) for all points at most `reach` away along each axis, and some others.
    template <class Visit>
    void for_each_near(const Vector& x, double reach, Visit&& visit) const {
        Vector lower{};
        Vector upper{};
        for (int a = 0; a < dimension_; ++a) {
            lower[a] = x[a] - reach;
            upper[a] = x[a] + reach;
            if (!(lower[a] <= box_.upper[a] && upper[a] >= box_.lower[a])) return;
        }
        const Cell first = cell_of(lower);
        const Cell last = cell_of(upper);
        for (std::int64_t i = first[0]; i <= last[0]; ++i)
            for (std::int64_t j = first[1]; j <= last[1]; ++j) {
                const std::int64_t end = key_of({i, j, last[2]});
                auto at =
                    std::ranges::lower_bound(cells_, key_of({i, j, first[2]}), {}, &Entry::first);
                for (; at != cells_.end() && at->first <= end; ++at) visit(at->second);
            }
    }

  private:
    using Cell = std::array<std::int64_t, max_dimension>;
    using Entry = std::pair<std::int64_t, LocalIndex>;

    Cell cell_of(const Vector& x) const {
        Cell cell{};
        for (int a = 0; a < dimension_; ++a) {
            // Halves, whose differences do not overflow.
            const double extent = box_.upper[a] / 2 - box_.lower[a] / 2;
            if (!(extent > 0)) continue;
            const double share = std::clamp((x[a] / 2 - box_.lower[a] / 2) / extent, 0., 1.);
            const auto number = static_cast<double>(num_cells_[a]);
            cell[a] = std::min(static_cast<std::int64_t>(share * number), num_cells_[a] - 1);
        }
        return cell;
    }
    std::int64_t key_of(const Cell& cell) const {
        return (cell[0] * num_cells_[1] + cell[1]) * num_cells_[2] + cell[2];
    }

    Box box_;
    int dimension_;
    Cell num_cells_{1, 1, 1};
    std::vector<Entry> cells_;  ///< cell and point, ascending
};

}  // namespace rrcb
