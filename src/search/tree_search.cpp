// Descent of a search through the tree.
#include "search/tree_search.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/part_share.hpp"
#include "arithmetic/quantum.hpp"
#include "bisection/bisection.hpp"
#include "cuts/owned_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rrcb {

TreeSearch::TreeSearch(const PartTree& tree, int rank, OpenPoints& open, const Guide* guide)
    : tree_(tree),
      guide_(guide),
      rank_(rank),
      all_sizes_(tree.rule.size_of(root_of(tree.num_parts, tree.shape))),
      layout_{.is_weighted = tree.rule.common_weight != 1, .limits = tree.limits},
      open_(open) {
    const PartRange own = parts_on(rank, tree.num_parts, tree.num_owners);
    first_own_ = own.first;
    end_own_ = own.end;
    Node root{root_of(tree.num_parts, tree.shape), tree.box, tree.weight};
    root.are_parts_counted = guide && guide->is_counted;
    enter(std::move(root));
}

int TreeSearch::owner_of(const Descent& at) const {
    return rrcb::owner_of(at, tree_.num_parts, tree_.num_owners);
}

/// Returns true if this rank needs the cut of a node, or the weight of a part.
bool TreeSearch::takes_part(const Descent& at) const {
    const bool holds_own_parts =
        at.first_part < end_own_ && first_own_ < at.first_part + at.num_parts;
    return guide_ || holds_own_parts || !open_.is_empty(at);
}

/// Starts the search for the cut of a node. If no counting is needed, continues with the children
/// at once.
void TreeSearch::enter(Node&& node) {
    if (ends_at(node)) return;
    const Descent at = node.at;
    const double share = at.is_part() ? 1 : tree_.rule.share_below(at);
    const bool divides = share > 0 && share < 1;
    const bool stays = node.are_parts_counted && tree_.rule.may_stay(at, guide_->sums);
    if (at.is_part() || (node.weight > 0 && divides && !stays)) return add_node(std::move(node));
    node.are_parts_counted = node.are_parts_counted && divides;
    const double below = node.are_parts_counted ? weight_of(at.lower(), guide_->sums)
                         : share > 0            ? node.weight
                                                : 0;
    const Cut cut = cut_unsearched(node, share);
    note(at, cut);
    divide(std::move(node), cut, {}, below);
}

/// Returns true if nothing has to be searched at a node and below.
bool TreeSearch::ends_at(Node& node) {
    const Descent& at = node.at;
    if (node.are_parts_counted) {
        node.weight = weight_of(at, guide_->sums);
        return at.is_part() || tree_.rule.are_within(at, guide_->sums);
    }
    if (!takes_part(at)) return true;
    if (!at.is_part() || guide_) return at.is_part();
    const bool ends = node.is_counted && !is_tiny(at);
    if (ends) weigh_part(node);
    return ends;
}

/// Returns the cut of a node that needs no counting. A side of size 0 gets nothing. If the node has
/// no weight, all of it goes below, or the guide's cut is kept if there is a guide.
Cut TreeSearch::cut_unsearched(const Node& node, double share) const {
    const Descent& at = node.at;
    if (!guide_)
        return plane(tree_.cut_axes.empty() ? tree_.axes.front() : tree_.cut_axes[at.node],
                     share > 0 ? infinity : -infinity);
    const Cut& cut = guide_->cuts.tree[at.node];
    if (!(share > 0 && share < 1)) return plane(cut.axis, share > 0 ? infinity : -infinity);
    if (!guide_->limits) return cut;
    return guide_->limits->nearest(cut, guide_->limits->places(at, node.box, cut.axis));
}

void TreeSearch::add_node(Node&& entered) {
    Node& node = nodes_.emplace_back(std::move(entered));
    const Descent& at = node.at;
    if (!at.is_part()) {
        node.settled_below = open_.total_in(at.lower());
        node.settled_above = open_.total_in(at.upper());
    }
    node.search = guide_ ? search_from_guide(node) : search_in_box(node);
    node.is_taken = is_taken_at_once(node);
    if (!node.is_taken) return;
    node.search.stage = CutSearch::gathering;
    aim(node, static_cast<GlobalCount>(node.weight));
}

/// Returns true if the owner gathers all points of a node without counting them first.
bool TreeSearch::is_taken_at_once(const Node& node) const {
    if (node.at.is_part()) return false;
    const bool is_open =
        !guide_ || (!guide_->limits && guide_->brackets[node.at.node].lower == -infinity &&
                    guide_->brackets[node.at.node].upper == infinity);
    return is_open && tree_.rule.are_few(node.weight) && node.is_counted;
}

/// Divides the open points by a cut and continues with the children.
void TreeSearch::divide(Node&& node, const Cut& cut, const Lot& lot, double below) {
    open_.cut(node.at, cut, lot);
    // If a lot is divided, each side's weight may differ by up to one point from the requested one.
    // The next count measures it; until then the weight of the node is an upper bound.
    const bool divides_lot = lot.below > 0;
    const double above = divides_lot ? node.weight : node.weight - below;
    if (divides_lot) below = node.weight;
    const auto enter_side = [&](const Descent& at, const Box& box, double weight) {
        enter({at, box, weight, node.is_counted && !divides_lot, node.are_parts_counted});
    };
    enter_side(node.at.lower(), box_below(node.box, cut), below);
    enter_side(node.at.upper(), box_above(node.box, cut), above);
}

void TreeSearch::note(const Descent& at, const Cut& cut) {
    if (guide_)
        guide_->cuts.tree[at.node] = cut;
    else if (owner_of(at) == rank_)
        own_.emplace_back(at.node, cut);
}

/// Notes a cut that was found and continues with the children. The points of a lot are divided in
/// the order of their ranks.
void TreeSearch::end_at_cut(Node&& node, const LotAnswer& told) {
    if (guide_ || owner_of(node.at) == rank_) num_coincident_ += node.search.coincident;
    Cut cut = node.search.cut;
    Lot lot = lot_at(node.at, node.search);
    if (lot.below > 0) {
        cut.divides = 1;
        lot.before = rank_ < told.dividing_rank   ? -infinity
                     : rank_ > told.dividing_rank ? infinity
                                                  : told.before;
    }
    node.are_parts_counted = false;
    if (node.search.stage != CutSearch::centring) note(node.at, cut);
    divide(std::move(node), cut, lot, node.search.found_below);
}

/// Returns the lot of a finished search, from the view of the lowest rank.
Lot TreeSearch::lot_at(const Descent& at, const CutSearch& search) const {
    return {0, search.lot_below, tree_.rule.share_below(at)};
}

/// Ends a spread search at a part: notes its imbalance.
void TreeSearch::weigh_part(const Node& node) {
    if (owner_of(node.at) != rank_) return;
    imbalance_ = std::max(imbalance_, over_ideal(node.weight, tree_.weight, ideal_share(node.at)));
}

/// Returns a part's ideal share of the weight.
double TreeSearch::ideal_share(const Descent& at) const {
    return tree_.rule.size_of(at) / all_sizes_;
}

/// Returns whether a part is so small that the rounding error of a difference of weights matters.
/// Its points must then be weighed.
bool TreeSearch::is_tiny(const Descent& part) const {
    constexpr double least_share = 0x1p-20;
    const double share = tree_.rule.part_sizes.empty() ? 1 : ideal_share(part);
    return share > 0 && share < least_share;
}

/// Returns a new search for a cut, before anything is counted.
CutSearch TreeSearch::search_across(int axis, const Bracket& bracket, double weight) const {
    CutSearch search;
    search.cut.axis = axis;
    search.num_axes = tree_.plain_cuts ? 1 : tree_.dimension;
    search.cut.at.fill(-infinity);
    search.lower = bracket.lower;
    search.upper = bracket.upper;
    search.quantum = quantum_for(weight);
    return search;
}

Cuts TreeSearch::own_cuts(std::vector<Part> numbers) const {
    const auto num_cuts = static_cast<std::size_t>(tree_.num_parts) - 1;
    Cuts cuts{tree_.dimension, tree_.num_parts, std::vector<Cut>(num_cuts), tree_.shape,
              std::move(numbers)};
    for (const auto& [node, cut] : own_) cuts.tree[node] = cut;
    return cuts;
}

/// Returns a new search for the cut of a node, within the bracket of the guide.
CutSearch TreeSearch::search_from_guide(Node& node) const {
    const Descent& at = node.at;
    const Cut& cut = guide_->cuts.tree[at.node];
    Bracket bracket = guide_->brackets[at.node];
    if (guide_->limits) {
        node.places = guide_->limits->places(at, node.box, cut.axis);
        const AxisLimits& limits = guide_->limits->across(cut.axis);
        bracket.lower = limits.nearest(bracket.lower, node.places.first, node.places.last);
        bracket.upper = limits.nearest(bracket.upper, bracket.lower, node.places.last);
    } else {
        bracket.lower = std::max(bracket.lower, -std::numeric_limits<double>::max());
        // Only the half of the interval in which weight is missing is searched; complete intervals
        // would take 1 % more rounds.
        const double missing =
            node.are_parts_counted ? tree_.rule.missing_below(at, guide_->sums) : 0;
        if (missing > 0) bracket.lower = std::max(bracket.lower, cut.at[cut.axis]);
        if (missing < 0)
            bracket.upper = std::min(bracket.upper, std::nextafter(cut.at[cut.axis], infinity));
    }
    return search_across(cut.axis, bracket, node.weight);
}

/// If cuts have left their intervals, opens the points of their nodes beyond these.
void TreeSearch::widen() {
    std::vector<WiderNode> nodes;
    for (Node& node : nodes_) {
        if (!std::exchange(node.is_wider, false)) continue;
        const Bracket& before = guide_->brackets[node.at.node];
        nodes.push_back({node.at, node.search.chosen == 0 ? Bracket{-infinity, before.lower}
                                                          : Bracket{before.upper, infinity}});
    }
    if (!nodes.empty()) open_.widen(nodes);
}

}  // namespace rrcb
