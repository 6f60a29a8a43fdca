// How a central search starts from known cuts.
#include "arithmetic/infinity.hpp"
#include "bisection/bisection.hpp"
#include "search/tree_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rrcb {

void TreeSearch::start_from_guide(Node& node) {
    const Descent& at = node.at;
    const Cut& cut = guide_->cuts.tree[at.node];
    Bracket bracket = guide_->brackets[at.node];
    if (node.content.are_parts_counted) node.below = weight_of(at.lower(), guide_->sums.sums());
    if (guide_->limits) {
        node.places = guide_->limits->places(at, node.content.box, cut.axis);
        const AxisLimits& limits = guide_->limits->across(cut.axis);
        bracket.lower = limits.nearest(bracket.lower, node.places.first, node.places.last);
        bracket.upper = limits.nearest(bracket.upper, bracket.lower, node.places.last);
    } else {
        bracket = points_.interval(at.node);
        bracket.lower = std::max(bracket.lower, -std::numeric_limits<double>::max());
        // Whole intervals take 1 % more rounds; 1.5 % more points move from earlier cuts.
        const double missing = missing_below(at, node.content.weight, node.below);
        if (missing > 0) bracket.lower = std::max(bracket.lower, cut.at[cut.axis]);
        if (missing < 0)
            bracket.upper = std::min(bracket.upper, std::nextafter(cut.at[cut.axis], infinity));
    }
    node.search = search_across(cut.axis, bracket, node.content.weight);
}

/// Returns intervals in which the cuts are looked for first. Limits may move cuts anywhere.
std::vector<Bracket> TreeSearch::intervals() const {
    std::vector<Bracket> found(guide_->cuts.tree.size(), {-infinity, infinity});
    const auto find = [&](const auto& self, const Descent& at, int depth, double shifted) -> void {
        if (at.is_part()) return;
        const double share = tree_.rule.share_below(at);
        if (share > 0 && share < 1) found[at.node] = interval_of(at, depth, shifted);
        self(self, at.lower(), depth + 1, shifted);
        self(self, at.upper(), depth + 1, shifted);
    };
    if (!guide_->limits) find(find, root_of(guide_->cuts), 0, 0);
    return found;
}

/// Returns the interval of a node's cut. Cuts above may have `shifted` weight into the node or out
/// of it; `shifted` becomes what may cross cuts further down. If the weight below was counted, the
/// interval is wide enough for what is missing there.
Bracket TreeSearch::interval_of(const Descent& at, int depth, double& shifted) const {
    constexpr double caution = 3;   // uneven points; with less, lattices are collected twice
    constexpr double least = 0.25;  // brackets are estimates
    const Cut& cut = guide_->cuts.tree[at.node];
    Bracket interval = guide_->brackets[at.node];
    const auto sums = guide_->sums.sums();
    const double in_half = guide_->is_counted ? expected_error(depth) * weight_of(at, sums) : 0;
    if (in_half > 0) {
        const bool stays = shifted == 0 && tree_.rule.may_stay(at, sums);
        const double missing =
            stays ? 0 : missing_below(at, weight_of(at, sums), weight_of(at.lower(), sums));
        const double open = stays ? 0 : shifted / 2 / in_half + least;
        const auto widths = [&](double there) {
            return std::min(open + caution * std::max(there, 0.0) / in_half,
                            1 / expected_error(depth));  // that of all weight
        };
        const double value = std::clamp(cut.at[cut.axis], interval.lower, interval.upper);
        interval = {std::lerp(value, interval.lower, widths(-missing)),
                    std::lerp(value, interval.upper, widths(missing))};
        shifted = std::abs(missing) + shifted / 2;
    }
    // The cut may stay, and points at it may be on either side.
    const double value = cut.at[cut.axis];
    return {std::min(interval.lower, value),
            std::max(interval.upper, std::nextafter(value, infinity))};
}

/// Returns the weight that is to come below a node's cut; 0 if the present weight is not known.
double TreeSearch::missing_below(const Descent& at, double weight, double below) const {
    const bool is_known = !tree_.rule.is_exact && below != not_counted && weight > 0;
    return is_known ? tree_.rule.target_of(at, weight, below).target - below : 0;
}

/// Collects the points of nodes whose cuts have left their intervals.
void TreeSearch::collect_more() {
    std::vector<Descent> nodes;
    std::vector<Bracket> intervals;
    for (const Node& node : nodes_) {
        if (!node.is_wide) continue;
        const Bracket& before = points_.interval(node.at.node);
        nodes.push_back(node.at);
        intervals.push_back(node.search.chosen == 0 ? Bracket{-infinity, before.lower}
                                                    : Bracket{before.upper, infinity});
    }
    if (nodes.empty()) return;
    std::vector<Entries> found = points_.collect_more(nodes, intervals);
    auto next = found.begin();
    for (Node& node : nodes_) {
        if (!std::exchange(node.is_wide, false)) continue;
        node.candidates.insert(node.candidates.end(), next->begin(), next->end());
        node.content.entries.insert(node.content.entries.end(), next->begin(), next->end());
        ++next;
    }
}

/// Takes the weights of a node's parts over all ranks. Returns whether its cut may stay.
bool TreeSearch::take_sums(Node& node, std::span<const double> sums) const {
    std::ranges::copy(sums, guide_->sums.sums().begin() + node.at.first_part);
    node.below = weight_of(node.at.lower(), guide_->sums.sums());
    return tree_.rule.may_stay(node.at, guide_->sums.sums());
}

}  // namespace rrcb
