#include "estimate/turning.hpp"

#include "bisection/bisection.hpp"
#include "bisection/common_weight.hpp"
#include "bisection/limited_bisection.hpp"
#include "bisection/patches.hpp"
#include "cuts/number_search.hpp"
#include "cuts/tree.hpp"
#include "options/axis_order.hpp"
#include "options/call_kind.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace rrcb {

namespace {

std::vector<Overlap> overlaps_of(std::span<const CommonWeight> common, double weight,
                                 const Cuts& cuts) {
    constexpr double digits = 0x1p40;
    std::vector<Overlap> overlaps;
    for (const auto& [end, part, shared] : common)
        overlaps.push_back({part, cuts.part_at(end), std::llround(shared / weight * digits)});
    return overlaps;
}

std::vector<Part> numbers_of_groups(const NumberRule& rule, std::span<const Overlap> overlaps) {
    // Only groups of equal size may swap numbers; the last one may be smaller.
    const int num_full = rule.num_parts / rule.shape.group_size;
    std::map<std::pair<int, int>, GlobalCount> counts;
    for (const auto& [origin, part, count] : overlaps) {
        const std::pair groups(rule.group_of(origin), rule.group_of_part(part));
        if (groups.first < num_full && groups.second < num_full) counts[groups] += count;
    }
    std::vector<Overlap> of_groups;
    for (const auto& [groups, count] : counts)
        of_groups.push_back({groups.first, groups.second, count});
    return greedy_numbers(rule.of_groups(), of_groups);
}

/// Returns the number of each part with which most weight remains in its group and, within the
/// group, in its part.
std::vector<Part> best_numbers(const NumberRule& rule, std::vector<Overlap>& overlaps) {
    if (rule.shape.group_size == 1) return greedy_numbers(rule, overlaps);
    const std::vector<Part> groups = numbers_of_groups(rule, overlaps);
    for (Overlap& overlap : overlaps) overlap.part = rule.with_group(overlap.part, groups);
    std::erase_if(overlaps, [&](const Overlap& overlap) {
        return !rule.is_in_group(overlap.part, overlap.origin);
    });
    const std::vector<Part> numbers = greedy_numbers(rule, overlaps);
    std::vector<Part> result(numbers.size());
    for (Part part = 0; part < rule.num_parts; ++part)
        result[part] = numbers[rule.with_group(part, groups)];
    return result;
}

/// Returns the number of ghosts in one step, as a share of all points, if the cuts have this weight
/// near them. Assumes a cut-off radius of two mean spacings, which is about that of most codes.
double ghosts_of(double near_weight, double weight, const StatisticalDomain& domain,
                 GlobalCount num_points) {
    constexpr double spacings = 2;
    const double of_patch =
        static_cast<double>(num_points) / static_cast<double>(domain.patches.size());
    // The spacing is in half sides of a patch, as near_share is.
    const double spacing = 2 / std::pow(std::max(of_patch, 1.0), 1.0 / domain.dimension);
    return near_weight / weight * spacings * spacing / near_share;
}

}  // namespace

Bisection bisect_gathered(const StatisticalDomain& domain, const Contribution& all,
                          const Options& options, bool with_brackets,
                          std::span<const int> preferred, double* near_weight) {
    if (are_cuts_limited(options) && all.summary.num_points > 0)
        return bisect_within(all.summary.box, domain, options, with_brackets, preferred,
                             near_weight);
    return bisect(domain, options, with_brackets, all.summary.num_points, preferred, near_weight);
}

double keep_numbers(const StatisticalDomain& domain, std::span<const double> part_sizes,
                    const Cuts& earlier, Cuts& cuts) {
    const double weight = weight_of(domain);
    if (!(weight > 0)) return 0;
    const auto common = common_weights(domain, cuts, earlier);
    cuts.numbers = earlier.numbers;
    if (std::ranges::adjacent_find(part_sizes, std::ranges::not_equal_to{}) == part_sizes.end()) {
        std::vector<Overlap> overlaps = overlaps_of(common, weight, cuts);
        const NumberRule rule{cuts.num_parts, 1, false, {}, cuts.shape};
        const std::vector<Part> numbers = best_numbers(rule, overlaps);
        std::vector<Part> of_ends = numbers_of(cuts);
        for (Part& part : of_ends) part = numbers[part];
        if (numbers_of(cuts) != of_ends) cuts.numbers = std::move(of_ends);
    }
    double moved = 0;
    for (const auto& [end, part, shared] : common)
        if (cuts.part_at(end) != part) moved += shared;
    return moved / weight;
}

Bisection bisect_along(const StatisticalDomain& domain, const Contribution& all,
                       const Options& options, const Cuts& earlier) {
    constexpr double ghosts_of_a_move = 10;  // number of ghosts that cost as much as moving one
                                             // point
    constexpr double haste = 3;
    const bool with_brackets = is_refined(options);
    const std::vector<int> axes = axes_of(earlier.tree);
    double near_along = 0;
    Bisection along = bisect_gathered(domain, all, options, with_brackets, axes, &near_along);
    along.cuts.numbers = earlier.numbers;
    along.cuts.debt = earlier.debt;
    if (axes_of(along.cuts.tree) != axes)
        keep_numbers(domain, options.part_sizes, earlier, along.cuts);
    const double weight = weight_of(domain);
    if (is_longest(options.expert.axes.order) || !(weight > 0)) return along;
    double near_free = 0;
    Bisection free = bisect_gathered(domain, all, options, false, {}, &near_free);
    if (axes_of(free.cuts.tree) == axes) return along;
    const double saved = ghosts_of(near_along - near_free, weight, domain, all.summary.num_points);
    const double debt = earlier.debt + options.expert.axes.steps / ghosts_of_a_move * saved;
    along.cuts.debt = debt;
    // A cut that turns moves at least half a part, so a smaller debt cannot pay for it.
    if (!(haste * debt * options.num_parts > 0.5)) return along;
    const double moved_along = keep_numbers(domain, options.part_sizes, earlier, along.cuts);
    const double moved_free = keep_numbers(domain, options.part_sizes, earlier, free.cuts);
    if (!(haste * debt > moved_free - moved_along)) return along;
    if (!with_brackets) return free;
    std::vector<Part> numbers = std::move(free.cuts.numbers);
    free = bisect_gathered(domain, all, options, true);
    free.cuts.numbers = std::move(numbers);
    return free;
}

}  // namespace rrcb
