#include "bisection/limited_bisection.hpp"

#include "bisection/axis_choice.hpp"
#include "bisection/bisection.hpp"
#include "bisection/patches.hpp"
#include "bisection/place_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rrcb {

namespace {

/// Points as patches without extent.
void make_patches(StatisticalDomain& domain) {
    for (const MassPoint& point : domain.points)
        domain.patches.push_back({point.position, point.position, point.weight});
    domain.points = {};
}

/// Brackets about the cuts of a tree, at the shares that they are found to have below them.
void add_brackets(const StatisticalDomain& domain, const Descent& at, int depth,
                  Bisection& bisection) {
    if (at.is_part()) return;
    const Cut& cut = bisection.cuts.tree[at.node];
    const Halves halves = split_domain(domain, cut);
    const double weight = weight_of(domain);
    const double below = weight > 0 ? weight_of(halves.lower) / weight : 0;
    bisection.brackets.push_back(bracket_of(domain, cut, below, depth));
    add_brackets(halves.lower, at.lower(), depth + 1, bisection);
    add_brackets(halves.upper, at.upper(), depth + 1, bisection);
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

void append_shares(std::span<const double> weights, std::span<const double> sizes,
                   std::vector<double>& shares) {
    if (sizes.size() == 1) return;
    constexpr double rounding = 1e-9;
    const auto num_below = static_cast<std::size_t>(lower_parts(static_cast<int>(sizes.size())));
    const double of_sizes = share_below(sizes);
    const double of_weights = share_below(weights);
    const bool is_same = std::abs(of_weights - of_sizes) <= rounding ||
                         std::ranges::all_of(weights, [](double weight) { return weight == 0; });
    shares.push_back(is_same ? of_sizes : of_weights);
    append_shares(weights.first(num_below), sizes.first(num_below), shares);
    append_shares(weights.subspan(num_below), sizes.subspan(num_below), shares);
}

}  // namespace

Bisection bisect_within(const Box& points, StatisticalDomain domain, const Options& options,
                        bool with_brackets) {
    make_patches(domain);
    const int dimension = domain.dimension;
    const AxisChoice axis_of(options, points, dimension);
    CutLimits limits(options, points, dimension, {axis_of.given(options.num_parts), {}});
    limits.require_room();
    const int effort =
        options.cut_rule == CutRule::midpoint
            ? 0
            : PlaceSearch::affordable_effort(domain.patches.size(), dimension, options.num_parts);
    Bisection result{{dimension, options.num_parts, {}}, {}, {}};
    PlaceSearch search(limits, axis_of, options, domain);
    const Piece whole{std::move(domain), root_of(result.cuts), limits.region(), 0};
    Outcome outcome = search.solve(whole, 0);
    if (!search.is_good(whole, outcome) && effort > 0) {
        Outcome better = search.solve_all(whole, effort);
        if (better.heaviest < outcome.heaviest) outcome = std::move(better);
    }
    result.cuts.tree = std::move(outcome.tree);
    result.part_weights = std::move(outcome.weights);
    if (with_brackets) add_brackets(whole.domain, whole.at, 0, result);
    return result;
}

std::vector<double> planned_shares(std::span<const double> part_weights,
                                   std::span<const double> part_sizes) {
    std::vector<double> shares;
    append_shares(part_weights, part_sizes, shares);
    return shares;
}

void move_into_places(const Box& points, const Options& options, Cuts& cuts) {
    CutLimits limits(options, points, cuts.dimension);
    limits.require_room();
    move_node(limits, root_of(cuts), limits.region(), cuts);
}

}  // namespace rrcb
