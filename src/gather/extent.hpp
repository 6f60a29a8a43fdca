#pragma once

#include <rrcb/passes.hpp>

#include <limits>
#include <span>
#include <vector>

namespace rrcb {

/// Extent and weight of the points of a rank, or of several.
///
/// `first[a]` and `last[a]` are the ends of their positions in the order across axis a, see
/// position_order.hpp: infinite if there are no points.
struct Extent {
    double count = 0;
    double weight = 0;
    std::array<Vector, max_dimension> first = all_at(std::numeric_limits<double>::infinity());
    std::array<Vector, max_dimension> last = all_at(-std::numeric_limits<double>::infinity());

    Box box() const;

  private:
    static constexpr std::array<Vector, max_dimension> all_at(double value) {
        const Vector corner{value, value, value};
        return {corner, corner, corner};
    }
};

/// Returns the extent of the points of a rank.
Extent extent_of(const PointSummary& summary);

/// Adds the points of another extent.
void join(Extent& extent, const Extent& other, int dimension);

/// Appends an extent as 2 + 2 dimension^2 doubles.
void append_extent(const Extent& extent, int dimension, std::vector<double>& doubles);

/// Returns the extents in the order appended.
std::vector<Extent> read_extents(std::span<const double> doubles, int dimension);

}  // namespace rrcb
