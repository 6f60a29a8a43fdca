// Estimates the intervals in which the cuts of a guide will most likely end. Points outside of them
// need not be searched.
#include "arithmetic/infinity.hpp"
#include "bisection/bisection.hpp"
#include "search/tree_search.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

/// Returns the interval of a node's cut. Moving the cuts above may bring the weight `shifted` into
/// the node or take it out; on return, `shifted` is the weight that may cross cuts further down.
Bracket interval_of(const Descent& at, int depth, const TargetRule& rule, const Guide& guide,
                    double& shifted) {
    constexpr double caution = 3;   // for uneven points; if it is less, lattices need a second
                                    // collection
    constexpr double least = 0.25;  // because the brackets are estimates
    const Cut& cut = guide.cuts.tree[at.node];
    Bracket interval = guide.brackets[at.node];
    const auto sums = guide.sums;
    const double in_half = guide.is_counted ? expected_error(depth) * weight_of(at, sums) : 0;
    if (in_half > 0) {
        const bool stays = shifted == 0 && rule.may_stay(at, sums);
        const double missing = stays ? 0 : rule.missing_below(at, sums);
        const double open = stays ? 0 : shifted / 2 / in_half + least;
        const auto widths = [&](double there) {
            return std::min(open + caution * std::max(there, 0.0) / in_half,
                            1 / expected_error(depth));  // contains all weight
        };
        const double value = std::clamp(cut.at[cut.axis], interval.lower, interval.upper);
        interval = {std::lerp(value, interval.lower, widths(-missing)),
                    std::lerp(value, interval.upper, widths(missing))};
        shifted = std::abs(missing) + shifted / 2;
    }
    // The cut may be kept, and points at its position may be on either side, so the interval
    // includes it.
    const double value = cut.at[cut.axis];
    return {std::min(interval.lower, value),
            std::max(interval.upper, std::nextafter(value, infinity))};
}

}  // namespace

std::vector<Bracket> likely_intervals(const TargetRule& rule, const Guide& guide) {
    std::vector<Bracket> found(guide.cuts.tree.size(), {-infinity, infinity});
    const auto find = [&](const auto& self, const Descent& at, int depth, double shifted) -> void {
        if (at.is_part()) return;
        const double share = rule.share_below(at);
        const double weight =
            guide.is_counted ? weight_of(at, guide.sums) : rule.weight_per_size * rule.size_of(at);
        if (share > 0 && share < 1 && !rule.are_few(weight))
            found[at.node] = interval_of(at, depth, rule, guide, shifted);
        self(self, at.lower(), depth + 1, shifted);
        self(self, at.upper(), depth + 1, shifted);
    };
    if (!guide.limits) find(find, root_of(guide.cuts), 0, 0);
    return found;
}

}  // namespace rrcb
