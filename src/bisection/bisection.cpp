#include "bisection/bisection.hpp"

#include "bisection/axis_choice.hpp"
#include "bisection/patches.hpp"
#include "bisection/point_selection.hpp"
#include "bisection/weighted_quantile.hpp"
#include "options/option_table.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/bisection.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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

struct Task {
    const Options& options;
    AxisChoice axis_of;
    bool with_brackets;
    Bisection result;
};

/// The cut that leaves the share `below` (0 ... 1) of the domain's weight or extent below it.
Cut choose_cut(const StatisticalDomain& domain, double below, int depth, const Task& task) {
    const double weight = weight_of(domain);
    const Box box = extent_of(domain);
    const int axis = task.axis_of(task.result.cuts.tree.size(), depth, box);
    const auto a = static_cast<std::size_t>(axis);
    // First: a side of size 0 stays empty whatever there is to divide.
    if (below >= 1) return plane(axis, infinity);
    if (below <= 0 || !(weight > 0)) return plane(axis, -infinity);
    if (task.options.cut_rule == CutRule::midpoint)
        return plane(axis, std::lerp(box.lower[a], box.upper[a], below));
    return weighted_quantile(Profile(domain, axis), below * weight, task.options.plain_cuts);
}

void bisect_node(StatisticalDomain domain, std::span<const double> sizes, int depth, Task& task) {
    if (sizes.size() == 1) {
        task.result.part_weights.push_back(weight_of(domain));
        return;
    }
    const auto num_below = static_cast<std::size_t>(lower_parts(static_cast<int>(sizes.size())));
    const double below = share_below(sizes);
    const Cut cut = choose_cut(domain, below, depth, task);
    task.result.cuts.tree.push_back(cut);
    if (task.with_brackets) task.result.brackets.push_back(bracket_of(domain, cut, below, depth));
    Halves halves = split_domain(domain, cut);
    domain.patches = {};
    bisect_node(std::move(halves.lower), sizes.first(num_below), depth + 1, task);
    bisect_node(std::move(halves.upper), sizes.subspan(num_below), depth + 1, task);
}

/// Brings the points below a plane to the front; returns how many they are.
std::size_t divide_by(const Cut& cut, int dimension, std::span<MassPoint> points) {
    // Clang 14 can't read the library's partition of ranges.
    const auto above = std::partition(points.begin(), points.end(), [&](const MassPoint& point) {
        return !is_above(cut, point.position, dimension);
    });
    return static_cast<std::size_t>(above - points.begin());
}

/// Cuts a node of points and divides them in place; returns how many lie below.
std::size_t cut_points(std::span<MassPoint> points, double below, int depth, const Task& task,
                       Cut& cut) {
    const int dimension = task.result.cuts.dimension;
    const Box box = extent_of(points);
    const double weight = weight_of(points);
    const int axis = task.axis_of(task.result.cuts.tree.size(), depth, box);
    const auto a = static_cast<std::size_t>(axis);
    // First: a side of size 0 stays empty whatever there is to divide.
    cut = plane(axis, below >= 1 ? infinity : -infinity);
    if (below >= 1) return points.size();
    if (below <= 0 || !(weight > 0)) return 0;
    if (task.options.cut_rule == CutRule::midpoint) {
        cut = plane(axis, std::lerp(box.lower[a], box.upper[a], below));
        return divide_by(cut, dimension, points);
    }
    return select_below(points, dimension, below * weight, task.options.plain_cuts, cut);
}

/// Bracket in which the cut of real points may lie: between the points at the shares about its own.
Bracket bracket_between(std::span<MassPoint> points, std::size_t num_below, const Cut& cut,
                        double below, int depth) {
    if (points.empty()) return {};
    const auto axis = static_cast<std::size_t>(cut.axis);
    const auto coordinate = [&](std::span<MassPoint> from, double index) {
        const auto k = std::clamp(index, 0.0, static_cast<double>(from.size() - 1));
        const auto at = from.begin() + static_cast<std::ptrdiff_t>(k);
        std::ranges::nth_element(from, at, {},
                                 [&](const MassPoint& p) { return p.position[axis]; });
        return at->position[axis];
    };
    const double margin = expected_error(depth);
    const auto count = static_cast<double>(points.size());
    const auto lower = points.first(num_below);
    const auto upper = points.subspan(num_below);
    const double from =
        lower.empty() ? coordinate(upper, 0) : coordinate(lower, (below - margin) * count);
    const double to =
        upper.empty()
            ? coordinate(lower, count)
            : coordinate(upper, (below + margin) * count - static_cast<double>(num_below));
    return {from, std::nextafter(to, infinity)};
}

void bisect_points(std::span<MassPoint> points, std::span<const double> sizes, int depth,
                   Task& task) {
    if (sizes.size() == 1) {
        task.result.part_weights.push_back(weight_of(points));
        return;
    }
    const auto num_parts_below =
        static_cast<std::size_t>(lower_parts(static_cast<int>(sizes.size())));
    const double below = share_below(sizes);
    Cut cut;
    const std::size_t num_below = cut_points(points, below, depth, task, cut);
    task.result.cuts.tree.push_back(cut);
    if (task.with_brackets)
        task.result.brackets.push_back(bracket_between(points, num_below, cut, below, depth));
    bisect_points(points.first(num_below), sizes.first(num_parts_below), depth + 1, task);
    bisect_points(points.subspan(num_below), sizes.subspan(num_parts_below), depth + 1, task);
}

}  // namespace

double share_below(std::span<const double> sizes) {
    const auto middle = sizes.begin() + lower_parts(static_cast<int>(sizes.size()));
    const double below = std::accumulate(sizes.begin(), middle, 0.0);
    const double all = below + std::accumulate(middle, sizes.end(), 0.0);
    return all > 0 ? below / all : 0;
}

double expected_error(int depth) {
    return std::min(0.25, 0.01 * std::exp2(depth / 2.0));
}

Bisection bisect(StatisticalDomain domain, const Options& options, bool with_brackets) {
    const bool of_points = !domain.points.empty();
    const Box box = of_points ? extent_of(domain.points) : extent_of(domain);
    Task task{options, {options, box, domain.dimension}, with_brackets, {}};
    task.result.cuts.dimension = domain.dimension;
    task.result.cuts.num_parts = options.num_parts;
    if (of_points) {
        bisect_points(domain.points, options.part_sizes, 0, task);
    } else {
        bisect_node(std::move(domain), options.part_sizes, 0, task);
    }
    return std::move(task.result);
}

Bisection bisect(StatisticalDomain domain, int num_parts, std::span<const double> part_sizes,
                 CutRule rule) {
    require(num_parts >= 1, "num_parts must be at least 1");
    Options options;
    options.num_parts = num_parts;
    options.part_sizes.assign(part_sizes.begin(), part_sizes.end());
    if (part_sizes.empty()) options.part_sizes.assign(static_cast<std::size_t>(num_parts), 1.0);
    options.cut_rule = rule;
    check_dimension(domain.dimension, "the domain");
    check_part_sizes(options, domain.dimension);
    return bisect(std::move(domain), options, false);
}

}  // namespace rrcb
