// How a central search starts from known cuts.
#include "arithmetic/infinity.hpp"
#include "bisection/bisection.hpp"
#include "search/tree_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rrcb {

namespace {

constexpr double largest = std::numeric_limits<double>::max();

}  // namespace

void TreeSearch::start_from_guide(Node& node) {
    const Descent& at = node.at;
    if (node.content.are_parts_counted) node.below = weight_of(at.lower(), guide_->sums.sums());
    const int axis = guide_->cuts.tree[at.node].axis;
    Bracket bracket = bracket_of(at, node.content.depth, node.content.weight, node.below);
    if (guide_->limits) {
        node.places = guide_->limits->places(at, node.content.box, axis);
        const AxisLimits& limits = guide_->limits->across(axis);
        bracket.lower = limits.nearest(bracket.lower, node.places.first, node.places.last);
        bracket.upper = limits.nearest(bracket.upper, bracket.lower, node.places.last);
    } else {
        const Bracket& interval = points_.interval(at.node);
        const bool is_inside = bracket.lower < interval.upper && bracket.upper > interval.lower;
        if (!is_inside) bracket = {-largest, infinity};
        bracket.lower = std::max(bracket.lower, interval.lower);
        bracket.upper = std::min(bracket.upper, interval.upper);
    }
    node.search = search_across(axis, bracket, node.content.weight);
}

/// Takes the points of this rank that are known to be on either side of a node's cut.
void TreeSearch::take_known(Node& node) const {
    node.below_here = points_.total_in(node.at.lower());
    node.above_here = points_.total_in(node.at.upper());
}

/// Returns intervals in which the cuts are looked for first. Limits may move cuts anywhere.
std::vector<Bracket> TreeSearch::intervals() const {
    std::vector<Bracket> found(guide_->cuts.tree.size(), {-infinity, infinity});
    const auto find = [&](const auto& self, const Descent& at, int depth) -> void {
        if (at.is_part()) return;
        self(self, at.lower(), depth + 1);
        self(self, at.upper(), depth + 1);
        const double share = tree_.rule.share_below(at);
        if (!(share > 0 && share < 1)) return;
        const auto sums = guide_->sums.sums();
        Bracket& interval = found[at.node];
        interval = bracket_of(at, depth, weight_of(at, sums),
                              guide_->is_counted ? weight_of(at.lower(), sums) : not_counted);
        // The cut may stay, and points at it may be on either side.
        const Cut& cut = guide_->cuts.tree[at.node];
        const double value = cut.at[cut.axis];
        interval.lower = std::min(interval.lower, value);
        interval.upper = std::max(interval.upper, std::nextafter(value, infinity));
    };
    if (!guide_->limits) find(find, root_of(guide_->cuts), 0);
    return found;
}

/// Returns the bracket of a node's cut. If the cut is known to be off in one direction, because the
/// weight below was counted, the bracket is on that side, and wide enough to find it.
Bracket TreeSearch::bracket_of(const Descent& at, int depth, double weight, double below) const {
    constexpr double caution = 2;
    Bracket bracket = guide_->brackets[at.node];
    if (tree_.rule.is_exact || guide_->limits || below == not_counted || !(weight > 0))
        return bracket;
    const Cut& cut = guide_->cuts.tree[at.node];
    const double value = std::clamp(cut.at[cut.axis], bracket.lower, bracket.upper);
    const double error = (tree_.rule.target_of(at, weight, below).target - below) / weight;
    const double widths = std::max(1.0, caution * std::abs(error) / expected_error(depth));
    if (error < 0) bracket.upper = std::nextafter(value, infinity);
    if (error > 0) bracket.lower = value;
    return {std::max(std::lerp(value, bracket.lower, widths), -largest),
            std::lerp(value, bracket.upper, widths)};
}

/// Appends the weights of the parts below a node by the current cuts on this rank.
void TreeSearch::count_parts(const Node& node, std::vector<double>& payload) const {
    const auto weights = guide_->sums.here().subspan(node.at.first_part, node.at.num_parts);
    std::ranges::fill(weights, 0.0);
    points_.count_parts(node.at, node.content.entries, guide_->cuts, guide_->sums.here());
    payload.insert(payload.end(), weights.begin(), weights.end());
}

/// Collects the points of nodes whose cuts have left their intervals.
void TreeSearch::collect_more() {
    std::vector<std::size_t> nodes;
    std::vector<Wanted> wanted;
    for (const Node& node : nodes_) {
        if (!node.is_wide) continue;
        const Bracket& before = points_.interval(node.at.node);
        nodes.push_back(node.at.node);
        wanted.push_back({node.at.first_part, node.at.num_parts, node.search.cut.axis,
                          node.search.chosen == 0 ? Bracket{-infinity, before.lower}
                                                  : Bracket{before.upper, infinity}});
    }
    if (wanted.empty()) return;
    std::vector<Entries> found = points_.collect_more(nodes, wanted);
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
    guide_->sums.set_sums(node.at.first_part, sums);
    node.below = weight_of(node.at.lower(), guide_->sums.sums());
    return tree_.rule.may_stay(node.at, guide_->sums.sums());
}

}  // namespace rrcb
