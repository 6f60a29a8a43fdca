#include "paper/point_selection.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/position_order.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

/// A range of coincident points in the order of points, and the weight of all smaller points.
struct EqualPoints {
    std::size_t begin;
    std::size_t end;
    double below;
    double weight;
};

/// Moves the points that coincide with the one at which the cumulative weight reaches the target
/// next to each other, and smaller points before them.
EqualPoints select(std::span<MassPoint> points, const PositionOrder& before, double target) {
    // Round-off must not decide on which side of a gap between clusters the cut is.
    const double enough = target - 1e-12 * target;
    std::size_t first = 0;
    std::size_t last = points.size();
    double below = 0;
    // Invariant: the point is in first ... last - 1. The points before this range are smaller and
    // weigh `below`; the points after it are greater.
    while (last - first > 1) {
        const std::size_t middle = first + (last - first) / 2;
        const auto left = points.subspan(first, last - first);
        std::ranges::nth_element(left, left.begin() + (middle - first), before,
                                 &MassPoint::position);
        const double weight = weight_of(points.subspan(first, middle - first));
        if (below + weight >= enough) {
            last = middle;
        } else {
            below += weight;
            first = middle;
        }
    }
    const Vector selected = points[first].position;
    const auto at = points.begin() + first;
    const std::size_t begin =
        std::partition(points.begin(), at,
                       [&](const MassPoint& point) { return before(point.position, selected); }) -
        points.begin();
    const std::size_t end =
        std::partition(at, points.end(),
                       [&](const MassPoint& point) { return !before(selected, point.position); }) -
        points.begin();
    return {begin, end, below - weight_of(points.subspan(begin, first - begin)),
            weight_of(points.subspan(begin, end - begin))};
}

/// Puts a cut between the last point below it and the first point above: halfway, or exactly on the
/// latter if `on`. Uses the first axis on which these points differ.
void cut_between(const Vector& last_below, const Vector& first_above, const PositionOrder& order,
                 bool on, Cut& cut) {
    auto deciding = order.axes().begin();
    for (; last_below[*deciding] == first_above[*deciding]; ++deciding)
        cut.at[*deciding] = first_above[*deciding];
    const std::size_t axis = *deciding;
    const double lower = last_below[axis];
    const double upper = first_above[axis];
    cut.at[axis] = on ? upper : std::max(std::nextafter(lower, infinity), lower / 2 + upper / 2);
}

}  // namespace

double weight_of(std::span<const MassPoint> points) {
    double weight = 0;
    for (const MassPoint& point : points) weight += point.weight;
    return weight;
}

std::size_t select_below(std::span<MassPoint> points, int dimension, double target, bool plain,
                         Cut& cut) {
    const PositionOrder order(cut.axis, 0, plain ? 1 : dimension);
    const EqualPoints ties = select(points, order, target);
    const double missing = target - ties.below;
    const bool above = missing < ties.weight / 2;
    const std::size_t num_below = above ? ties.begin : ties.end;
    const int axis = cut.axis;
    cut.at.fill(-infinity);
    if (num_below == 0 || num_below == points.size()) {
        cut.at[axis] = num_below == 0 ? points[ties.begin].position[axis] : infinity;
        return num_below;
    }
    const MassPoint last_below =
        *std::ranges::max_element(points.first(num_below), order, &MassPoint::position);
    const MassPoint first_above =
        *std::ranges::min_element(points.subspan(num_below), order, &MassPoint::position);
    cut_between(last_below.position, first_above.position, order, above, cut);
    return num_below;
}

}  // namespace rrcb
