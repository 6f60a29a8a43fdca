#include "bisection/limited_bisection.hpp"

#include "bisection/axis_choice.hpp"
#include "bisection/bisection.hpp"
#include "bisection/patches.hpp"
#include "bisection/slice.hpp"
#include "bisection/weighted_quantile.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double weight_below(const StatisticalDomain& domain, const Cut& plane) {
    const int a = plane.axis;
    double weight = 0;
    for (const Patch& patch : domain.patches)
        weight += weight_below(slice_of(patch, a), plane.at[a]);
    return weight;
}

/// An axis that a cut may cross, and its places.
struct Way {
    int axis;
    Places places;
};

/// Returns the axes that have places for the cut of a node: `preferred`, then the others from the
/// longest of `extent` down.
std::vector<Way> ways_across(const Descent& at, const Box& region, const Box& extent, int preferred,
                             CutLimits& limits) {
    std::vector<Way> ways;
    for (int axis = 0; axis < limits.dimension(); ++axis) {
        if (limits.are_axes_given() && axis != preferred) continue;
        const Places places = limits.places(at, region, axis);
        if (!places.empty()) ways.push_back({axis, places});
    }
    std::ranges::stable_sort(ways, std::greater<>(), [&](const Way& way) {
        const int a = way.axis;
        return way.axis == preferred ? infinity : extent.upper[a] / 2 - extent.lower[a] / 2;
    });
    return ways;
}

/// A cut, and the weight below it.
struct Trial {
    Cut cut;
    double below;
};

/// A node and the domain that it divides.
struct Piece {
    StatisticalDomain domain;  ///< of patches
    Descent at;
    Box region;
    int depth;
};

struct Task {
    const Options& options;
    AxisChoice axis_of;
    CutLimits limits;
    bool with_brackets;
    Bisection result;

    double share_below(const Descent& at) const {
        const std::span sizes(options.part_sizes);
        return rrcb::share_below(sizes.subspan(at.first_part, at.num_parts), at.lower_parts());
    }
};

Trial trial_in(const StatisticalDomain& domain, int axis, double place) {
    const Cut cut = plane(axis, place);
    return {cut, weight_below(domain, cut)};
}

/// Returns the cut at an allowed place of `way` with about the weight `target` below it. Of the
/// grid lines on both sides of the exact place, takes the one with the smaller error.
Trial trial_at(const StatisticalDomain& domain, const Way& way, double target, const Task& task) {
    const bool is_plain = task.options.axes.plain;
    const AxisLimits& limits = task.limits.across(way.axis);
    const Cut cut = weighted_quantile({domain, way.axis}, target, is_plain);
    const double value = cut.at[way.axis];
    const double place = limits.nearest(value, way.places.first, way.places.last);
    if (place == value && !is_plain) return {cut, weight_of(split_domain(domain, cut).lower)};
    const Trial trial = trial_in(domain, way.axis, place);
    const double other = value < place ? limits.place_before(place) : limits.place_behind(place);
    if (!limits.has_grid() || other < way.places.first || other > way.places.last) return trial;
    const Trial beside = trial_in(domain, way.axis, other);
    return std::abs(beside.below - target) < std::abs(trial.below - target) ? beside : trial;
}

Trial trial_across(const Piece& piece, const Way& way, const Task& task) {
    const double weight = weight_of(piece.domain);
    if (weight > 0) return trial_at(piece.domain, way, task.share_below(piece.at) * weight, task);
    const double middle = way.places.first / 2 + way.places.last / 2;
    const AxisLimits& limits = task.limits.across(way.axis);
    return trial_in(piece.domain, way.axis,
                    limits.nearest(middle, way.places.first, way.places.last));
}

/// Returns the first cut with a bearable error, or else the one with the least error.
Cut cut_in_places(const Piece& piece, int preferred, const Box& extent, Task& task) {
    constexpr double bearable = 0.005;
    const double weight = weight_of(piece.domain);
    const double share = task.share_below(piece.at);
    const double lighter = std::min(share, 1 - share) * weight;
    Trial best{};
    double least = infinity;
    for (const Way& way : ways_across(piece.at, piece.region, extent, preferred, task.limits)) {
        const Trial trial = trial_across(piece, way, task);
        const double error = std::abs(trial.below - share * weight);
        if (error < least) best = trial;
        least = std::min(least, error);
        if (least <= bearable * lighter) break;
    }
    return best.cut;
}

/// Returns the cut of a node. If the parts of one side have no size, all points are on the other.
Cut choose_cut(const Piece& piece, Task& task) {
    const Box extent = extent_of(piece.domain);
    const int axis = task.axis_of(piece.at.node, piece.depth, extent);
    if (task.limits.divides(piece.at)) return cut_in_places(piece, axis, extent, task);
    return plane(axis, task.share_below(piece.at) > 0 ? infinity : -infinity);
}

void bisect_piece(Piece piece, Task& task) {
    if (piece.at.is_part()) {
        task.result.part_weights.push_back(weight_of(piece.domain));
        return;
    }
    const Cut cut = choose_cut(piece, task);
    task.result.cuts.tree.push_back(cut);
    Halves halves = split_domain(piece.domain, cut);
    if (task.with_brackets) {
        const double below = task.share_below(piece.at);
        task.result.brackets.push_back(bracket_of(piece.domain, cut, below, piece.depth));
    }
    piece.domain.patches = {};
    bisect_piece(
        {std::move(halves.lower), piece.at.lower(), box_below(piece.region, cut), piece.depth + 1},
        task);
    bisect_piece(
        {std::move(halves.upper), piece.at.upper(), box_above(piece.region, cut), piece.depth + 1},
        task);
}

void move_node(CutLimits& limits, const Descent& at, const Box& region, Cuts& cuts) {
    if (at.is_part()) return;
    Cut& cut = cuts.tree[at.node];
    if (limits.divides(at)) {
        const Way way = ways_across(at, region, region, cut.axis, limits).front();
        if (way.axis != cut.axis) cut = plane(way.axis, way.places.first / 2 + way.places.last / 2);
        cut = limits.nearest(cut, way.places);
    }
    move_node(limits, at.lower(), box_below(region, cut), cuts);
    move_node(limits, at.upper(), box_above(region, cut), cuts);
}

}  // namespace

Bisection bisect_within(const Box& points, StatisticalDomain domain, const Options& options,
                        bool with_brackets) {
    const int dimension = domain.dimension;
    const AxisChoice axis_of(options, points, dimension);
    const Descent root = root_of(options.num_parts, options.tree);
    Task task{options,
              axis_of,
              {options, points, dimension, {axis_of.given(root), {}}},
              with_brackets,
              {{dimension, options.num_parts, {}, {}, options.tree}, {}, {}}};
    task.limits.require_room();
    bisect_piece({std::move(domain), root, task.limits.region(), 0}, task);
    return std::move(task.result);
}

void move_into_places(const Box& points, const Options& options, Cuts& cuts) {
    CutLimits limits(options, points, cuts.dimension);
    limits.require_room();
    move_node(limits, root_of(cuts), limits.region(), cuts);
}

}  // namespace rrcb
