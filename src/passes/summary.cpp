#include "passes/summary.hpp"

#include "arithmetic/position_order.hpp"
#include "arithmetic/running_sums.hpp"
#include "options/validation.hpp"
#include "passes/point_layout.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

/// Returns the points from `first` to `last` - 1.
Points range_of(const Points& points, LocalIndex first, LocalIndex last) {
    Points range = points;
    range.count = last - first;
    for (const void*& axis : range.axes)
        if (axis != nullptr) axis = static_cast<const std::byte*>(axis) + first * points.stride;
    return range;
}

/// Updates the first and last positions in the order across `axis` with those points that reach
/// `lower` or `upper`, the extremes of all points so far.
void widen(const Points& points, double lower, double upper, int axis, PointSummary& summary) {
    const PositionOrder is_before(axis, 1, points.dimension);
    Vector& first = summary.first[axis];
    Vector& last = summary.last[axis];
    visit_layout(points, [&](const auto& x) {
        for (LocalIndex i = 0; i < points.count; ++i) {
            const double value = x(i, axis);
            if (value != lower && value != upper) continue;
            const Vector position = points.position(i);
            if (value == lower && (first[axis] != value || is_before(position, first)))
                first = position;
            if (value == upper && (last[axis] != value || is_before(last, position)))
                last = position;
        }
    });
}

/// Adds a block of points whose box is `of_block`.
void add_block(const Points& block, const Box& of_block, PointSummary& summary) {
    for (int a = 0; a < block.dimension; ++a) {
        double& lower = summary.box.lower[a];
        double& upper = summary.box.upper[a];
        // Few blocks contain extremes, unless the points are sorted along an axis.
        const bool has_ends = of_block.lower[a] <= lower || of_block.upper[a] >= upper;
        lower = std::min(lower, of_block.lower[a]);
        upper = std::max(upper, of_block.upper[a]);
        if (has_ends) widen(block, lower, upper, a, summary);
    }
}

}  // namespace

PointSummary summary_of_weights(const Points& points) {
    check_lengths(points);
    PointSummary summary;
    summary.count = points.count;
    summary.weight = static_cast<double>(points.count);
    if (points.count == 0) return summary;
    summary.lightest = summary.heaviest = 1;
    if (points.weights.empty()) return summary;
    summary.lightest = std::numeric_limits<double>::infinity();
    summary.heaviest = summary.weight = 0;
    for (const double weight : points.weights) {
        summary.lightest = std::min(summary.lightest, weight);
        summary.heaviest = std::max(summary.heaviest, weight);
        summary.weight += weight;
    }
    // If a weight is NaN or infinite, so is the sum.
    if (summary.lightest < 0 || !std::isfinite(summary.weight)) reject_weights(points);
    return summary;
}

PointSummary summary_of(const Points& points) {
    constexpr LocalIndex points_in_block = 512;
    PointSummary summary = summary_of_weights(points);
    bool are_finite = true;
    in_ranges(points.count, points_in_block, [&](LocalIndex first, LocalIndex last) {
        const Points block = range_of(points, first, last);
        const Box of_block = box_of(block);
        for (int a = 0; a < points.dimension; ++a)
            are_finite = are_finite && !std::isnan(of_block.lower[a]);
        if (are_finite) add_block(block, of_block, summary);
    });
    if (!are_finite) reject_coordinates(points);
    return summary;
}

}  // namespace rrcb
