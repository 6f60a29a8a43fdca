#include "bisection/bisection.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/non_stop.hpp"
#include "bisection/axis_choice.hpp"
#include "bisection/limited_bisection.hpp"
#include "bisection/patches.hpp"
#include "bisection/profile.hpp"
#include "bisection/weighted_quantile.hpp"
#include "options/axis_order.hpp"
#include "options/option_table.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/detail/bisection.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rrcb {

namespace {

struct Task {
    const Options& options;
    const AxisChoice& axis_choice;
    CutLimits* limits;  ///< null if cuts are not limited
    bool with_brackets;
    std::span<const int> preferred;  ///< preferred axis of each cut; may be empty
    double* near_weight;             ///< gets the weight near all cuts; null if it is not needed
    double reach = 0;                ///< weight is near a cut up to this distance
    double light = 0;  ///< pieces up to this weight have too few points to estimate the weight near
                       ///< a cut
    bool shows_near = false;  ///< whether the patches have extents, so that weight near cuts can be
                              ///< estimated
    Bisection result{};
    Profile profile{};  ///< of the piece being cut
};

double share_below_node(const Descent& at, const Options& options) {
    const auto sizes = std::span(options.part_sizes).subspan(at.first_part, at.num_parts);
    return share_below(sizes, at.lower_parts());
}

/// Returns the preferred axis of a cut if the piece has an extent along it; with
/// AxisOrder::longest() its extent must also be at least 90 % of the longest. Otherwise returns the
/// longest axis.
int usual_axis(const Piece& piece, std::span<const int> axes, const Task& task) {
    const Box& extent = task.profile.extent();
    const int longest = longest_axis(extent, axes, nearly);
    if (task.preferred.empty()) return longest;
    const int preferred = task.preferred[piece.at.node];
    if (std::ranges::find(axes, preferred) == axes.end()) return longest;
    const auto half = [&](int axis) { return extent.upper[axis] / 2 - extent.lower[axis] / 2; };
    const double enough = is_longest(task.options.expert.axes.order) ? nearly * half(longest) : 0;
    return half(preferred) > 0 && half(preferred) >= enough ? preferred : longest;
}

/// Replaces a cut across the usual axis by one across another axis, if that one has clearly less
/// weight near it.
void choose_fewest(const Profile& profile, std::span<const int> axes, double target,
                   const Task& task, Cut& best) {
    // The fewer patches there are, the larger is the error of the weight near a cut.
    const auto num_patches = static_cast<double>(profile.domain().patches.size());
    const double enough = nearly - 1 / std::sqrt(num_patches);
    const bool plain = task.options.expert.axes.plain;
    const double reach = profile.reach();
    const Box& extent = profile.extent();
    const auto near = [&](const Cut& cut) {
        return profile.weight_near(cut.axis, cut.at[cut.axis], reach);
    };
    double fewest = near(best);
    for (const int axis : axes) {
        if (axis == best.axis || !(extent.lower[axis] < extent.upper[axis])) continue;
        // Most axes are ruled out by a coarse cut already.
        const double coarse = profile.range_of(axis, target, profile.weight() / 64).value;
        const bool is_known = std::isfinite(coarse);
        if (is_known && profile.weight_near(axis, coarse, reach) > (1 + enough) / 2 * fewest)
            continue;
        const Cut cut = weighted_quantile(profile, axis, target, plain);
        const double fewer = near(cut);
        if (!(fewer < enough * fewest)) continue;
        best = cut;
        fewest = fewer;
    }
}

/// Returns the cut that leaves the share `below` (0 to 1) of the piece's weight below it. Leaves
/// the piece's domain in `task.profile`.
Cut choose_cut(const Piece& piece, double below, Task& task) {
    Profile& profile = task.profile;
    profile.take(piece.domain);
    const Box& extent = profile.extent();
    const auto axes = task.axis_choice(piece.at.node, piece.depth);
    const double weight = profile.weight();
    const bool counts_near = !is_longest(task.options.expert.axes.order) && task.preferred.empty();
    const int usual = usual_axis(piece, axes, task);
    if (task.limits && task.limits->divides(piece.at))
        return cut_in_places(piece, profile, below, usual, counts_near, task.options, *task.limits);
    // These tests come first: a side of size 0 is empty even if the domain has no weight.
    if (below >= 1) return plane(usual, infinity);
    if (below <= 0 || !(weight > 0)) return plane(usual, -infinity);
    // Coincident patches all go to one side.
    if (extent.lower == extent.upper) return plane(usual, below < 0.5 ? -infinity : infinity);
    const double target = below * weight;
    Cut cut = weighted_quantile(profile, usual, target, task.options.expert.axes.plain);
    const bool shows_near = task.shows_near && weight > task.light;
    if (counts_near && shows_near && axes.size() > 1)
        choose_fewest(profile, axes, target, task, cut);
    return cut;
}

/// Returns the range in which the exact cut is expected, because the domain is only an estimate.
/// `below` is the share of the weight below the cut, `depth` the number of cuts above. Many steps
/// are allowed because a small cluster is found only after many of them.
Bracket bracket_of(const Profile& profile, const Cut& cut, double below, int depth) {
    if (profile.domain().patches.empty()) return {};
    const double margin = expected_error(depth);
    const double error = margin / 8 * profile.weight();
    constexpr int most_steps = 64;
    const auto range_of = [&](double share) {
        Profile::Range range;
        if (!(share > 0 && share < 1 && error > 0)) return range;
        range = profile.range_of(cut.axis, share * profile.weight(), error, most_steps);
        if (std::isfinite(range.value)) range.lower = range.upper = range.value;
        return range;
    };
    const double first = profile.extent().lower[cut.axis];
    const double last = profile.extent().upper[cut.axis];
    const double value = std::clamp(cut.at[cut.axis], first, last);
    const double lower = std::clamp(range_of(below - margin).lower, first, value);
    const double upper = std::clamp(range_of(below + margin).upper, value, last);
    return {lower, std::nextafter(upper, infinity)};
}

/// Returns the distance up to which weight counts as near a cut; it stands for the cut-off radius
/// of a code.
double near_reach(const Profile& profile) {
    return near_share * profile.mean_half_side();
}

void bisect_piece(Piece piece, Task& task) {
    const auto& [domain, at, region, depth] = piece;
    if (at.is_part()) {
        task.result.part_weights.push_back(weight_of(domain));
        return;
    }
    const double below = share_below_node(at, task.options);
    const Cut cut = choose_cut(piece, below, task);
    task.result.cuts.tree.push_back(cut);
    const Profile& profile = task.profile;
    const double value = cut.at[cut.axis];
    if (task.near_weight && task.reach > 0 && std::isfinite(value))
        *task.near_weight += profile.weight_within(cut.axis, value, task.reach);
    if (task.with_brackets) task.result.brackets.push_back(bracket_of(profile, cut, below, depth));
    // Two parts need no domains, only weights.
    if (at.num_parts == 2 && is_plane(cut, domain.dimension) && std::isfinite(value)) {
        const double weight_below = profile.weight_below(cut.axis, value);
        task.result.part_weights.push_back(weight_below);
        task.result.part_weights.push_back(std::max(0.0, profile.weight() - weight_below));
        return;
    }
    Halves halves = split_domain(std::move(piece.domain), cut);
    bisect_piece({std::move(halves.lower), at.lower(), box_below(region, cut), depth + 1}, task);
    bisect_piece({std::move(halves.upper), at.upper(), box_above(region, cut), depth + 1}, task);
}

/// Returns the weight within `reach` of the cut of a node and of all cuts below it.
double weight_near(StatisticalDomain domain, const Descent& at, const Cuts& cuts, double reach) {
    if (at.is_part() || domain.patches.empty()) return 0;
    const Cut& cut = cuts.tree[at.node];
    const double value = cut.at[cut.axis];
    double weight =
        std::isfinite(value) ? Profile(domain).weight_within(cut.axis, value, reach) : 0;
    Halves halves = split_domain(std::move(domain), cut);
    weight += weight_near(std::move(halves.lower), at.lower(), cuts, reach);
    return weight + weight_near(std::move(halves.upper), at.upper(), cuts, reach);
}

/// Bisects the domain. All cuts are at allowed positions if `task.limits` is given.
Bisection bisect(StatisticalDomain domain, GlobalCount num_points, Task&& task) {
    constexpr double few_points = 16;
    const NonStop arithmetic;
    const Options& options = task.options;
    task.profile.take(domain);
    const double weight = task.profile.weight();
    if (num_points > 0) task.light = few_points / static_cast<double>(num_points) * weight;
    task.result.cuts = {domain.dimension, options.num_parts, {}, options.expert.tree};
    const auto num_parts = static_cast<std::size_t>(options.num_parts);
    task.result.cuts.tree.reserve(num_parts - 1);
    task.result.brackets.reserve(task.with_brackets ? num_parts - 1 : 0);
    task.result.part_weights.reserve(num_parts);
    const Box region = task.limits ? task.limits->region() : everywhere;
    task.shows_near = task.profile.mean_half_side() > 0;
    task.reach = near_reach(task.profile);
    bisect_piece({std::move(domain), root_of(task.result.cuts), region, 0}, task);
    return std::move(task.result);
}

}  // namespace

double share_below(std::span<const double> sizes, int num_below) {
    constexpr double least = 0x1p-50;
    const auto middle = sizes.begin() + num_below;
    const double below = std::accumulate(sizes.begin(), middle, 0.0);
    const double above = std::accumulate(middle, sizes.end(), 0.0);
    const double all = below + above;
    if (!(below > least * all)) return 0;
    return above > least * all ? below / all : 1;
}

double expected_error(int depth) {
    return std::min(0.25, 0.01 * std::exp2(depth / 2.0));
}

Bisection bisect(StatisticalDomain domain, const Options& options, bool with_brackets,
                 GlobalCount num_points, std::span<const int> preferred, double* near_weight) {
    const AxisChoice axis_choice(options, Profile(domain).extent(), domain.dimension);
    return bisect(std::move(domain), num_points,
                  {options, axis_choice, nullptr, with_brackets, preferred, near_weight});
}

bool are_axes_good(const StatisticalDomain& domain, const Cuts& cuts, const Cuts& fresh,
                   double enough) {
    const NonStop arithmetic;
    const double reach = near_reach(Profile(domain));
    const auto near = [&](const Cuts& some) {
        return weight_near(domain, root_of(some), some, reach);
    };
    return !(reach > 0) || enough * near(cuts) <= near(fresh);
}

Bisection bisect_within(const Box& points, StatisticalDomain domain, const Options& options,
                        bool with_brackets, std::span<const int> preferred, double* near_weight) {
    const int dimension = domain.dimension;
    const AxisChoice axis_choice(options, points, dimension);
    CutLimits limits(options, points, dimension,
                     axis_choice.given(root_of(options.num_parts, options.expert.tree)));
    limits.require_room();
    return bisect(std::move(domain), 0,
                  {options, axis_choice, &limits, with_brackets, preferred, near_weight});
}

Bisection bisect(StatisticalDomain domain, int num_parts, std::span<const double> part_sizes) {
    require(num_parts >= 1, "num_parts must be at least 1");
    check_dimension(domain.dimension, "the domain");
    return locally([&] {
        Options options;
        options.num_parts = num_parts;
        options.part_sizes.assign(part_sizes.begin(), part_sizes.end());
        if (part_sizes.empty()) options.part_sizes.assign(num_parts, 1.0);
        check_part_sizes(options, domain.dimension);
        return bisect(std::move(domain), options, false);
    });
}

}  // namespace rrcb
