#include "bisection/place_search.hpp"

#include "bisection/bisection.hpp"
#include "bisection/patches.hpp"
#include "bisection/slice.hpp"
#include "bisection/weighted_quantile.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <span>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Places that are looked at across one axis.
constexpr int most_trials = 8;

double weight_below(const StatisticalDomain& domain, const Cut& plane) {
    const auto a = static_cast<std::size_t>(plane.axis);
    double weight = 0;
    for (const Patch& patch : domain.patches)
        weight += weight_below(slice_of(patch, a), plane.at[a]);
    return weight;
}

Piece lower_of(const Piece& piece, const Cut& cut, StatisticalDomain&& domain) {
    return {std::move(domain), piece.at.lower(), box_below(piece.region, cut), piece.depth + 1};
}

Piece upper_of(const Piece& piece, const Cut& cut, StatisticalDomain&& domain) {
    return {std::move(domain), piece.at.upper(), box_above(piece.region, cut), piece.depth + 1};
}

Outcome join(const Cut& cut, const Outcome& lower, const Outcome& upper) {
    Outcome both{std::max(lower.heaviest, upper.heaviest), {cut}, lower.weights};
    both.tree.insert(both.tree.end(), lower.tree.begin(), lower.tree.end());
    both.tree.insert(both.tree.end(), upper.tree.begin(), upper.tree.end());
    both.weights.insert(both.weights.end(), upper.weights.begin(), upper.weights.end());
    return both;
}

}  // namespace

std::vector<Way> ways_across(const Descent& at, const Box& region, const Box& extent, int preferred,
                             CutLimits& limits) {
    std::vector<Way> ways;
    for (int axis = 0; axis < limits.dimension(); ++axis) {
        if (limits.are_axes_given() && axis != preferred) continue;
        const Places places = limits.places(at, region, axis);
        if (!places.empty()) ways.push_back({axis, places});
    }
    std::ranges::stable_sort(ways, std::greater<>(), [&](const Way& way) {
        const auto a = static_cast<std::size_t>(way.axis);
        return way.axis == preferred ? infinity : extent.upper[a] / 2 - extent.lower[a] / 2;
    });
    return ways;
}

PlaceSearch::PlaceSearch(CutLimits& limits, const AxisChoice& axis_of, const Options& options,
                         const StatisticalDomain& domain)
    : limits_(limits),
      axis_of_(axis_of),
      options_(options),
      enough_(1.001 * weight_of(domain) /
              std::accumulate(options.part_sizes.begin(), options.part_sizes.end(), 0.0)) {}

Outcome PlaceSearch::solve(const Piece& piece, int effort) {
    if (piece.at.is_part()) {
        const double weight = weight_of(piece.domain);
        return {weight / sizes_of(piece.at)[0], {}, {weight}};
    }
    if (!limits_.divides(piece.at)) return solve_beside_none(piece, effort);
    if (effort == 0) return solve_halves(piece, best_first_trial(piece).cut, 0).outcome;
    Outcome best{infinity};
    for (const Way& way : ways_of(piece))
        if (!is_good(piece, best)) look_along(piece, way, effort - 1, best);
    return best;
}

Outcome PlaceSearch::solve_all(const Piece& piece, int effort) {
    Outcome best = solve(piece, effort);
    if (is_good(piece, best) || best.tree.empty()) return best;
    Halves halves = split_domain(piece.domain, best.tree[0]);
    const Piece lower = lower_of(piece, best.tree[0], std::move(halves.lower));
    const Piece upper = upper_of(piece, best.tree[0], std::move(halves.upper));
    if (!limits_.divides(piece.at)) return best;
    const Outcome again = join(best.tree[0], solve_all(lower, effort), solve_all(upper, effort));
    return again.heaviest < best.heaviest ? again : best;
}

bool PlaceSearch::is_good(const Piece& piece, const Outcome& outcome) const {
    if (outcome.heaviest <= enough_) return true;
    const auto sizes = sizes_of(piece.at);
    const double size = std::accumulate(sizes.begin(), sizes.end(), 0.0);
    return outcome.heaviest * size <= 1.001 * weight_of(piece.domain);
}

int PlaceSearch::affordable_effort(std::size_t num_patches, int dimension, int num_parts) {
    constexpr double most_visits = 4e5;
    const int levels = std::bit_width(static_cast<unsigned>(num_parts - 1));
    double visits = static_cast<double>(num_patches) * levels;
    int effort = 0;
    while (effort < levels && (visits *= most_trials * dimension) <= most_visits) ++effort;
    return effort;
}

std::span<const double> PlaceSearch::sizes_of(const Descent& at) const {
    return std::span(options_.part_sizes)
        .subspan(static_cast<std::size_t>(at.first_part), static_cast<std::size_t>(at.num_parts));
}

PlaceSearch::Solved PlaceSearch::solve_halves(const Piece& piece, const Cut& cut, int effort) {
    Halves halves = split_domain(piece.domain, cut);
    const Outcome lower = solve(lower_of(piece, cut, std::move(halves.lower)), effort);
    const Outcome upper = solve(upper_of(piece, cut, std::move(halves.upper)), effort);
    return {join(cut, lower, upper), upper.heaviest > lower.heaviest};
}

/// Keeps everything off the side whose parts have no size.
Outcome PlaceSearch::solve_beside_none(const Piece& piece, int effort) {
    const bool is_below = share_below(sizes_of(piece.at)) > 0;
    const int axis = axis_of_(piece.at.node, piece.depth, extent_of(piece.domain));
    const Cut cut = plane(axis, is_below ? infinity : -infinity);
    const auto num_none =
        static_cast<std::size_t>((is_below ? piece.at.upper() : piece.at.lower()).num_parts);
    const Outcome none{0, std::vector<Cut>(num_none - 1, plane(axis, -infinity)),
                       std::vector<double>(num_none)};
    StatisticalDomain domain = piece.domain;
    if (is_below) return join(cut, solve(lower_of(piece, cut, std::move(domain)), effort), none);
    return join(cut, none, solve(upper_of(piece, cut, std::move(domain)), effort));
}

std::vector<Way> PlaceSearch::ways_of(const Piece& piece) {
    const Box extent = extent_of(piece.domain);
    const int preferred = axis_of_(piece.at.node, piece.depth, extent);
    return ways_across(piece.at, piece.region, extent, preferred, limits_);
}

PlaceSearch::Trial PlaceSearch::trial_in(const Piece& piece, int axis, double place) const {
    const Cut cut = plane(axis, place);
    return {cut, weight_below(piece.domain, cut)};
}

/// The cut in the places of `way` with about the weight `target` below it.
PlaceSearch::Trial PlaceSearch::trial_at(const Piece& piece, const Way& way, double target) const {
    const AxisLimits& limits = limits_.across(way.axis);
    const Cut cut = weighted_quantile({piece.domain, way.axis}, target, options_.plain_cuts);
    const double value = cut.at[static_cast<std::size_t>(way.axis)];
    const double place = limits.nearest(value, way.places.first, way.places.last);
    if (place == value && !options_.plain_cuts) return {cut, target};
    const Trial trial = trial_in(piece, way.axis, place);
    const double other = value < place ? limits.place_before(place) : limits.place_behind(place);
    if (!limits.has_grid() || other < way.places.first || other > way.places.last) return trial;
    const Trial beside = trial_in(piece, way.axis, other);
    return std::abs(beside.below - target) < std::abs(trial.below - target) ? beside : trial;
}

PlaceSearch::Trial PlaceSearch::first_trial(const Piece& piece, const Way& way) const {
    const double share = share_below(sizes_of(piece.at));
    const Box extent = extent_of(piece.domain);
    const auto a = static_cast<std::size_t>(way.axis);
    const double weight = weight_of(piece.domain);
    if (weight > 0 && options_.cut_rule == CutRule::weighted_fraction)
        return trial_at(piece, way, share * weight);
    const double value = weight > 0 ? std::lerp(extent.lower[a], extent.upper[a], share)
                                    : way.places.first / 2 + way.places.last / 2;
    return trial_in(piece, way.axis,
                    limits_.across(way.axis).nearest(value, way.places.first, way.places.last));
}

/// Across the first axis on which a cut is about as good as asked for, or the best.
PlaceSearch::Trial PlaceSearch::best_first_trial(const Piece& piece) {
    constexpr double bearable = 0.005;
    const double weight = weight_of(piece.domain);
    const double share = share_below(sizes_of(piece.at));
    const double lighter = std::min(share, 1 - share) * weight;
    Trial best{};
    double least = infinity;
    for (const Way& way : ways_of(piece)) {
        const Trial trial = first_trial(piece, way);
        const double error = std::abs(trial.below - share * weight);
        if (error < least) best = trial;
        least = std::min(least, error);
        if (least <= bearable * lighter || options_.cut_rule == CutRule::midpoint) break;
    }
    return best;
}

/// Looks for better cuts across one axis: moves the cut towards the side with the heaviest
/// part, by half of the weight that is left there, as long as that has places. In the end, as
/// parts may be heavy for want of room as well, at both ends of the places.
void PlaceSearch::look_along(const Piece& piece, const Way& way, int effort, Outcome& best) {
    const AxisLimits& limits = limits_.across(way.axis);
    const auto a = static_cast<std::size_t>(way.axis);
    Way left = way;
    Trial trial = first_trial(piece, way);
    for (int k = 2; k < most_trials; ++k) {
        const auto [outcome, is_upper_heavier] = solve_halves(piece, trial.cut, effort);
        if (outcome.heaviest < best.heaviest) best = outcome;
        if (is_good(piece, best)) return;
        const double place = trial.cut.at[a];
        if (is_upper_heavier) left.places.first = limits.place_behind(place);
        if (!is_upper_heavier) left.places.last = limits.place_before(place);
        if (left.places.empty()) break;
        const double end = is_upper_heavier ? left.places.last : left.places.first;
        const double rest = trial_in(piece, way.axis, end).below;
        trial = trial_at(piece, left, trial.below / 2 + rest / 2);
    }
    for (const double end : {way.places.first, way.places.last}) {
        const Outcome outcome = solve_halves(piece, plane(way.axis, end), effort).outcome;
        if (outcome.heaviest < best.heaviest) best = outcome;
    }
}

}  // namespace rrcb
