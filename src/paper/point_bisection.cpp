#include "arithmetic/infinity.hpp"
#include "bisection/axis_choice.hpp"
#include "bisection/bisection.hpp"
#include "options/allowed_axes.hpp"
#include "options/option_table.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"
#include "paper/point_selection.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

Box extent_of(std::span<const MassPoint> points) {
    Box box;
    for (const MassPoint& point : points) {
        for (std::size_t a = 0; a < max_dimension; ++a) {
            box.lower[a] = std::min(box.lower[a], point.position[a]);
            box.upper[a] = std::max(box.upper[a], point.position[a]);
        }
    }
    return box;
}

struct PointTask {
    CutRule rule;
    bool plain_cuts;
    Bisection result;
};

/// Moves the points below a plane to the front. Returns their number.
std::size_t divide_by(const Cut& cut, int dimension, std::span<MassPoint> points) {
    // std::ranges::partition would do, but clang 14 cannot compile it with GCC's library.
    const auto above = std::partition(points.begin(), points.end(), [&](const MassPoint& point) {
        return !is_above(cut, point.position, dimension);
    });
    return static_cast<std::size_t>(above - points.begin());
}

/// Chooses the cut of a node and divides its points in place. Returns the number of points below.
std::size_t cut_points(std::span<MassPoint> points, double below, const PointTask& task, Cut& cut) {
    constexpr double longest_only = 1;
    const int dimension = task.result.cuts.dimension;
    const Box box = extent_of(points);
    const double weight = weight_of(points);
    const int axis = longest_axis(box, first_axes(dimension), longest_only);
    // These tests come first: a side of size 0 is empty even if the points have no weight.
    cut = plane(axis, below >= 1 ? infinity : -infinity);
    if (below >= 1) return points.size();
    if (below <= 0 || !(weight > 0)) return 0;
    if (task.rule == CutRule::midpoint) {
        cut = plane(axis, std::lerp(box.lower[axis], box.upper[axis], below));
        return divide_by(cut, dimension, points);
    }
    return select_below(points, dimension, below * weight, task.plain_cuts, cut);
}

void bisect_node(std::span<MassPoint> points, std::span<const double> sizes, PointTask& task) {
    if (sizes.size() == 1) {
        task.result.part_weights.push_back(weight_of(points));
        return;
    }
    const int num_parts_below = TreeShape{}.lower_parts(static_cast<int>(sizes.size()));
    Cut cut;
    const std::size_t num_below =
        cut_points(points, share_below(sizes, num_parts_below), task, cut);
    task.result.cuts.tree.push_back(cut);
    bisect_node(points.first(num_below), sizes.first(num_parts_below), task);
    bisect_node(points.subspan(num_below), sizes.subspan(num_parts_below), task);
}

}  // namespace

void check_sizes(int num_parts, std::span<const double> part_sizes) {
    Options options;
    options.num_parts = num_parts;
    options.part_sizes.assign(part_sizes.begin(), part_sizes.end());
    check_part_sizes(options, max_dimension);
}

Bisection bisect_points(std::vector<MassPoint> points, int dimension, int num_parts,
                        std::span<const double> part_sizes, CutRule rule, bool plain_cuts) {
    require(num_parts >= 1, "num_parts must be at least 1");
    check_dimension(dimension, "the points");
    return locally([&] {
        check_sizes(num_parts, part_sizes);
        std::vector<double> sizes(part_sizes.begin(), part_sizes.end());
        if (sizes.empty()) sizes.assign(num_parts, 1.0);
        PointTask task{rule, plain_cuts, {}};
        task.result.cuts.dimension = dimension;
        task.result.cuts.num_parts = num_parts;
        bisect_node(points, sizes, task);
        return std::move(task.result);
    });
}

}  // namespace rrcb
