#include "bisection/limited_bisection.hpp"

#include "arithmetic/infinity.hpp"
#include "bisection/axis_choice.hpp"
#include "bisection/bisection.hpp"
#include "bisection/patches.hpp"
#include "bisection/weighted_quantile.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

namespace {

/// An axis that a cut may cross, and the allowed places of the cut along it.
struct Way {
    int axis;
    Places places;
};

/// Returns the axes across which the node has allowed positions for its cut: first `preferred`,
/// then the others in descending order of `extent`.
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

Trial trial_in(const Profile& profile, int axis, double place) {
    return {plane(axis, place), profile.weight_below(axis, place)};
}

/// Returns a cut at an allowed position of `way` with about the weight `target` below it. If the
/// allowed positions are grid lines, compares the two next to the exact cut and takes the one with
/// the smaller error.
Trial trial_at(const Profile& profile, const Way& way, double target, bool is_plain,
               const AxisLimits& limits) {
    const Cut cut = weighted_quantile(profile, way.axis, target, is_plain);
    const double value = cut.at[way.axis];
    const double place = limits.nearest(value, way.places.first, way.places.last);
    if (place == value && !is_plain)
        return {cut, weight_of(split_domain(profile.domain(), cut).lower)};
    const Trial trial = trial_in(profile, way.axis, place);
    const double other = value < place ? limits.place_before(place) : limits.place_behind(place);
    if (!limits.has_grid() || other < way.places.first || other > way.places.last) return trial;
    const Trial beside = trial_in(profile, way.axis, other);
    return std::abs(beside.below - target) < std::abs(trial.below - target) ? beside : trial;
}

bool are_in_places(CutLimits& limits, const Descent& at, const Box& region, const Cuts& cuts) {
    if (at.is_part()) return true;
    const Cut& cut = cuts.tree[at.node];
    if (limits.divides(at)) {
        const Places places = limits.places(at, region, cut.axis);
        if (places.empty() || limits.nearest(cut, places).at != cut.at) return false;
    }
    return are_in_places(limits, at.lower(), box_below(region, cut), cuts) &&
           are_in_places(limits, at.upper(), box_above(region, cut), cuts);
}

}  // namespace

Cut cut_in_places(const Piece& piece, const Profile& profile, double share, int usual,
                  bool counts_near, const Options& options, CutLimits& limits) {
    constexpr double bearable = 0.005;
    const double weight = profile.weight();
    const double bearable_error = bearable * std::min(share, 1 - share) * weight;
    const double reach = counts_near ? profile.reach() : 0;
    Trial best{};
    double least = infinity;
    double fewest = infinity;
    for (const Way& way : ways_across(piece.at, piece.region, profile.extent(), usual, limits)) {
        const AxisLimits& across = limits.across(way.axis);
        const auto [first, last] = way.places;
        const Trial trial =
            weight > 0
                ? trial_at(profile, way, share * weight, options.expert.axes.plain, across)
                : trial_in(profile, way.axis, across.nearest(first / 2 + last / 2, first, last));
        const double error = std::abs(trial.below - share * weight);
        const bool is_first_bearable = least > bearable_error && error < least;
        const double fewer = profile.weight_near(way.axis, trial.cut.at[way.axis], reach);
        if (is_first_bearable || (error <= bearable_error && fewer < nearly * fewest)) {
            best = trial;
            fewest = fewer;
        }
        least = std::min(least, error);
        if (least <= bearable_error && !counts_near) break;
    }
    return best.cut;
}

bool are_in_places(const Box& points, const Cuts& cuts, const Options& options) {
    CutLimits limits(options, points, cuts.dimension);
    return limits.has_room() && are_in_places(limits, root_of(cuts), limits.region(), cuts);
}

}  // namespace rrcb
