#include "gather/extent.hpp"

#include "arithmetic/position_order.hpp"
#include "arithmetic/running_sums.hpp"

#include <algorithm>

namespace rrcb {

namespace {

/// Returns a range of consecutive points.
Points range_of(const Points& points, LocalIndex first, LocalIndex last) {
    Points range = points;
    range.count = last - first;
    const std::size_t begin = first * points.stride;
    for (int a = 0; a < points.dimension; ++a) {
        if (points.has_floats())
            range.float_axes[a] = points.float_axes[a].subspan(begin);
        else
            range.axes[a] = points.axes[a].subspan(begin);
    }
    return range;
}

/// Widens the ends of the order across `axis` by the points in `box`.
void widen(const Points& points, const Box& box, int axis, Extent& extent) {
    const PositionOrder is_before(axis, 1, points.dimension);
    Vector& first = extent.first[axis];
    Vector& last = extent.last[axis];
    for (LocalIndex i = 0; i < points.count; ++i) {
        const double value = points.coordinate(i, axis);
        const bool is_first = value == box.lower[axis];
        const bool is_last = value == box.upper[axis];
        if (!is_first && !is_last) continue;
        const Vector position = points.position(i);
        if (is_first && (first[axis] != value || is_before(position, first))) first = position;
        if (is_last && (last[axis] != value || is_before(last, position))) last = position;
    }
}

/// Calls `visit` with each of the doubles that make up an extent.
template <class AnyExtent, class Visit>
void for_each_double(AnyExtent& extent, int dimension, Visit&& visit) {
    visit(extent.count);
    visit(extent.weight);
    for (int a = 0; a < dimension; ++a) {
        for (int b = 0; b < dimension; ++b) {
            visit(extent.first[a][b]);
            visit(extent.last[a][b]);
        }
    }
}

}  // namespace

Box Extent::box() const {
    Box box;
    for (std::size_t a = 0; a < max_dimension; ++a) {
        box.lower[a] = first[a][a];
        box.upper[a] = last[a][a];
    }
    return box;
}

Extent extent_of(const Points& points, const Box& box, double weight) {
    constexpr LocalIndex points_in_block = 256;
    Extent extent;
    extent.count = static_cast<double>(points.count);
    extent.weight = weight;
    // Only blocks that touch a face of the box hold ends of the order, and few of them do.
    in_ranges(points.count, points_in_block, [&](LocalIndex first, LocalIndex last) {
        const Points block = range_of(points, first, last);
        const Box its_own = bounding_box(block);
        for (int a = 0; a < points.dimension; ++a)
            if (its_own.lower[a] == box.lower[a] || its_own.upper[a] == box.upper[a])
                widen(block, box, a, extent);
    });
    return extent;
}

void join(Extent& extent, const Extent& other, int dimension) {
    extent.count += other.count;
    extent.weight += other.weight;
    for (int a = 0; a < dimension; ++a) {
        const PositionOrder is_before(a, 0, dimension);
        extent.first[a] = std::min(extent.first[a], other.first[a], is_before);
        extent.last[a] = std::max(extent.last[a], other.last[a], is_before);
    }
}

void append_extent(const Extent& extent, int dimension, std::vector<double>& doubles) {
    for_each_double(extent, dimension, [&](double value) { doubles.push_back(value); });
}

std::vector<Extent> read_extents(std::span<const double> doubles, int dimension) {
    std::vector<Extent> extents;
    for (auto from = doubles.begin(); from != doubles.end();) {
        Extent& extent = extents.emplace_back();
        for_each_double(extent, dimension, [&](double& value) { value = *from++; });
    }
    return extents;
}

}  // namespace rrcb
