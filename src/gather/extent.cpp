#include "gather/extent.hpp"

#include "cells/running_sums.hpp"
#include "cuts/position_order.hpp"

#include <algorithm>

namespace rrcb {

namespace {

/// Returns a range of consecutive points.
Points range_of(const Points& points, LocalIndex first, LocalIndex last) {
    Points range = points;
    range.count = last - first;
    const std::size_t begin = first * points.stride;
    for (std::size_t a = 0; a < static_cast<std::size_t>(points.dimension); ++a) {
        if (points.has_floats())
            range.float_axes[a] = points.float_axes[a].subspan(begin);
        else
            range.axes[a] = points.axes[a].subspan(begin);
    }
    return range;
}

/// Widens the ends of the order across `axis` by the points in `box`.
void widen(const Points& points, const Box& box, int axis, Extent& extent) {
    const auto a = static_cast<std::size_t>(axis);
    const PositionOrder is_before(axis, 1, points.dimension);
    for (LocalIndex i = 0; i < points.count; ++i) {
        const double value = points.coordinate(i, axis);
        if (value != box.lower[a] && value != box.upper[a]) continue;
        const Vector position = points.position(i);
        const bool is_first = value == box.lower[a];
        const bool is_last = value == box.upper[a];
        if (is_first && (extent.first[a][a] != value || is_before(position, extent.first[a])))
            extent.first[a] = position;
        if (is_last && (extent.last[a][a] != value || is_before(extent.last[a], position)))
            extent.last[a] = position;
    }
}

/// Calls `visit` with each of the doubles that make up an extent.
template <class AnyExtent, class Visit>
void for_each_double(AnyExtent& extent, int dimension, Visit&& visit) {
    visit(extent.count);
    visit(extent.weight);
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
        for (std::size_t b = 0; b < static_cast<std::size_t>(dimension); ++b) {
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
        for (int axis = 0; axis < points.dimension; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            if (its_own.lower[a] == box.lower[a] || its_own.upper[a] == box.upper[a])
                widen(block, box, axis, extent);
        }
    });
    return extent;
}

void join(Extent& extent, const Extent& other, int dimension) {
    extent.count += other.count;
    extent.weight += other.weight;
    for (int axis = 0; axis < dimension; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const PositionOrder is_before(axis, 0, dimension);
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
