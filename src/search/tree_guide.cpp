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
    if (node.content.are_parts_counted)
        node.below = weight_of(node.at.lower(), guide_->sums.sums());
    const int axis = guide_->cuts.tree[node.at.node].axis;
    Bracket bracket = bracket_of(node);
    if (guide_->limits) {
        node.places = guide_->limits->places(node.at, node.content.box, axis);
        const AxisLimits& limits = guide_->limits->across(axis);
        bracket.lower = limits.nearest(bracket.lower, node.places.first, node.places.last);
        bracket.upper = limits.nearest(bracket.upper, bracket.lower, node.places.last);
    }
    node.search = search_across(axis, bracket, node.content.weight);
}

/// Returns the bracket of a node's cut. With a tolerance it is wider than for an exact cut, so that
/// a cut that is far off is found in as many rounds. If the cut is known to be off in one
/// direction, the bracket is on that side.
Bracket TreeSearch::bracket_of(const Node& node) const {
    constexpr double largest = std::numeric_limits<double>::max();
    constexpr double caution = 2;
    double widths = 4;
    Bracket bracket = guide_->brackets[node.at.node];
    if (tree_.rule.is_exact || guide_->limits) return bracket;
    const Cut& cut = guide_->cuts.tree[node.at.node];
    const double value = std::clamp(cut.at[cut.axis], bracket.lower, bracket.upper);
    if (node.content.are_parts_counted) {
        const double weight = node.content.weight;
        const double target = tree_.rule.target_of(node.at, weight, node.below).target;
        const double error = (target - node.below) / weight;
        widths *= std::max(1.0, caution * std::abs(error) / expected_error(node.content.depth));
        if (error < 0) bracket.upper = std::nextafter(value, infinity);
        if (error > 0) bracket.lower = value;
    }
    return {std::max(std::lerp(value, bracket.lower, widths), -largest),
            std::lerp(value, bracket.upper, widths)};
}

/// Writes the parts below a node by the current cuts, and appends their weights on this rank.
void TreeSearch::count_parts(const Node& node, std::vector<double>& payload) {
    const auto& fragments = node.content.fragments;
    const auto here = guide_->sums.here();
    write_parts(fragments, guide_->cuts, node.at, points_, parts_, here);
    if (fragments.empty()) return;
    payload.push_back(mark_of_parts);
    const auto weights = here.subspan(node.at.first_part, node.at.num_parts);
    payload.insert(payload.end(), weights.begin(), weights.end());
}

/// Goes on with a node, given the weights of its parts over all ranks.
void TreeSearch::take_sums(Node&& node, std::span<const double> sums) {
    guide_->sums.set_sums(node.at.first_part, sums);
    node.content.are_parts_counted = true;
    enter(node.at, std::move(node.content));
}

}  // namespace rrcb
