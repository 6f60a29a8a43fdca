// How a search goes down the tree, a central one from known cuts.
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

TreeSearch::TreeSearch(const PartTree& tree, int rank, const Box& box, PointPasses& points,
                       OpenPoints&& all)
    : tree_(tree),
      rank_(rank),
      dimension_(points.dimension()),
      all_sizes_(tree.rule.size_of(root_of(tree.num_parts, tree.shape))),
      layout_{.is_weighted = tree.rule.common_weight != 1},
      points_(points, std::move(all)) {
    const PartRange own = parts_on(rank, tree.num_parts, tree.num_ranks);
    first_own_ = own.first;
    end_own_ = own.end;
    enter({root_of(tree.num_parts, tree.shape), points_.all(), box, tree.weight});
}

TreeSearch::TreeSearch(const PartTree& tree, int rank, const Guide& guide, PointPasses& points,
                       OpenPoints&& memory)
    : tree_(tree),
      guide_(&guide),
      rank_(rank),
      dimension_(guide.cuts.dimension),
      all_sizes_(tree.rule.size_of(root_of(guide.cuts))),
      layout_{.is_weighted = tree.rule.common_weight != 1, .limits = tree.limits},
      points_(points, guide.cuts, intervals(), guide.has_parts, std::move(memory)) {
    Node root{root_of(guide.cuts), {}, guide.limits ? guide.limits->region() : Box{}, tree.weight};
    root.are_parts_counted = guide.is_counted;
    enter(std::move(root));
}

int TreeSearch::owner_of(const Descent& at) const {
    return is_central() ? 0 : rrcb::owner_of(at, tree_.num_parts, tree_.num_ranks);
}

/// Begins to search the cut of a node; goes on to its children if no counting is needed.
void TreeSearch::enter(Node&& node) {
    const Descent at = node.at;
    if (is_central()) node.entries = points_.admit(at, node.entries);
    if (ends_at(node)) return;
    const double share = at.is_part() ? 1 : tree_.rule.share_below(at);
    const bool divides = share > 0 && share < 1;
    const bool stays = node.are_parts_counted && tree_.rule.may_stay(at, guide_->sums);
    if (at.is_part() || (node.weight > 0 && divides && !stays)) return add_node(std::move(node));
    node.are_parts_counted = node.are_parts_counted && divides;
    const double below = node.are_parts_counted ? weight_of(at.lower(), guide_->sums)
                         : share > 0            ? node.weight
                                                : 0;
    const Cut cut = cut_unsearched(node, share);
    note(at.node, cut);
    divide(std::move(node), cut, {}, below);
}

/// Returns true if there is nothing to search at a node or below; then its part is written.
bool TreeSearch::ends_at(Node& node) {
    const Descent& at = node.at;
    if (node.are_parts_counted) {
        const auto sums = guide_->sums;
        node.weight = weight_of(at, sums);
        if (at.is_part()) return true;
        const bool ends = tree_.rule.are_within(at, sums);
        if (ends) points_.put_back(at.node, std::move(node.entries));
        return ends;
    }
    if (is_central()) return at.is_part();
    const bool holds_own_parts =
        at.first_part < end_own_ && first_own_ < at.first_part + at.num_parts;
    if (node.entries.empty() && !holds_own_parts) return true;
    const bool ends = at.is_part() && node.is_counted && !is_tiny(at);
    if (ends) weigh_part(node);
    return ends;
}

/// Returns the cut of a node without counting. A side of size 0 gets nothing. Without weight
/// all goes below, unless a guide's cut is kept.
Cut TreeSearch::cut_unsearched(const Node& node, double share) const {
    const Descent& at = node.at;
    if (!is_central())
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
    if (is_central()) {
        node.below_here = points_.total_in(at.lower());
        node.above_here = points_.total_in(at.upper());
        node.counts_parts = recounts() && !node.are_parts_counted;
        start_from_guide(node);
    } else {
        node.found = node.box;
        node.search = first_search(node);
    }
    node.is_taken = is_taken_at_once(node);
    if (!node.is_taken) return;
    node.search.stage = CutSearch::gathering;
    node.candidates = node.entries;
    aim(node, static_cast<GlobalCount>(node.weight));
}

/// Returns true if a node of this weight has so few points that a histogram has more numbers.
bool TreeSearch::are_few(double weight) const {
    return !layout_.is_weighted && weight <= layout_.num_bins / 4;
}

/// Returns true if the owner takes all points of a node, without counting them first.
bool TreeSearch::is_taken_at_once(const Node& node) const {
    const bool is_open = !is_central() || (guide_->limits == nullptr &&
                                           points_.interval(node.at.node).lower == -infinity &&
                                           points_.interval(node.at.node).upper == infinity);
    return is_open && are_few(node.weight) && node.is_counted && !node.at.is_part() &&
           !node.counts_parts;
}

/// Goes on below a cut.
void TreeSearch::divide(Node&& node, const Cut& cut, const Lot& lot, double below) {
    auto [lower, upper] = points_.divide(std::move(node.entries), cut, lot);
    // A side of a divided lot may weigh up to a point more or less than asked for. The next count
    // measures it; until then the node's weight is a bound.
    const bool divides_lot = lot.below > 0;
    const double above = divides_lot ? node.weight : node.weight - below;
    if (divides_lot) below = node.weight;
    const auto enter_side = [&](const Descent& at, Entries&& entries, const Box& box,
                                double weight) {
        enter({at, std::move(entries), box, weight, node.is_counted && !divides_lot,
               node.are_parts_counted});
    };
    enter_side(node.at.lower(), std::move(lower), box_below(node.box, cut), below);
    enter_side(node.at.upper(), std::move(upper), box_above(node.box, cut), above);
}

void TreeSearch::note(std::size_t node, const Cut& cut) {
    if (is_central()) {
        guide_->cuts.tree[node] = cut;
    } else {
        known_.emplace_back(node, cut);
    }
}

/// Goes on below a found cut. The points of a lot form one row over all ranks.
void TreeSearch::end_at_cut(Node&& node, const LotAnswer& told) {
    if (is_central() || owner_of(node.at) == rank_) num_coincident_ += node.search.coincident;
    Cut cut = node.search.cut;
    Lot lot = lot_at(node.at, node.search);
    if (lot.below > 0) {
        cut.divides = 1;
        lot.before = rank_ < told.dividing_rank   ? -infinity
                     : rank_ > told.dividing_rank ? infinity
                                                  : told.before;
    }
    node.are_parts_counted = false;
    if (node.search.stage != CutSearch::centring) note(node.at.node, cut);
    divide(std::move(node), cut, lot, node.search.below);
}

/// Returns the lot of a finished search, as seen by the first rank.
Lot TreeSearch::lot_at(const Descent& at, const CutSearch& search) const {
    return {0, search.lot_below, tree_.rule.share_below(at)};
}

/// Ends a spread search at a part.
void TreeSearch::weigh_part(const Node& node) {
    const Descent& at = node.at;
    points_.settle(node.entries, at.first_part);
    if (owner_of(at) != rank_) return;
    imbalance_ = std::max(imbalance_, over_ideal(node.weight, tree_.weight, ideal_share(at)));
}

void TreeSearch::finish() {
    if (is_central()) {
        points_.settle_rest();
        const std::span<double> weights = guide_->here;
        for (std::size_t p = 0; p < weights.size(); ++p)
            weights[p] = points_.total_of(static_cast<Part>(p)).weight;
    }
    points_.write_parts();
}

/// Returns a part's ideal share of the weight.
double TreeSearch::ideal_share(const Descent& at) const {
    return tree_.rule.size_of(at) / all_sizes_;
}

/// Returns whether the round-off of a remainder may be large compared with the weight of a part, so
/// that the points of the part must be weighed.
bool TreeSearch::is_tiny(const Descent& part) const {
    constexpr double least_share = 0x1p-20;
    const double share = tree_.rule.part_sizes.empty() ? 1 : ideal_share(part);
    return share > 0 && share < least_share;
}

/// Returns a search for the cut of a node before anything is counted.
CutSearch TreeSearch::search_across(int axis, const Bracket& bracket, double weight) const {
    CutSearch search;
    search.cut.axis = axis;
    search.num_axes = tree_.plain_cuts ? 1 : dimension_;
    search.cut.at.fill(-infinity);
    search.lower = bracket.lower;
    search.upper = bracket.upper;
    search.quantum = quantum_for(weight);
    return search;
}

Cuts TreeSearch::cuts() const {
    auto known = known_;
    std::ranges::sort(known, {}, [](const auto& one) { return one.first; });
    Cuts cuts{dimension_, tree_.num_parts, {}, {}, tree_.shape};
    for (const auto& [node, cut] : known) {
        cuts.tree.push_back(cut);
        cuts.nodes.push_back(static_cast<std::int32_t>(node));
    }
    return cuts;
}

void TreeSearch::start_from_guide(Node& node) {
    const Descent& at = node.at;
    const Cut& cut = guide_->cuts.tree[at.node];
    Bracket bracket = guide_->brackets[at.node];
    if (node.are_parts_counted) node.below = weight_of(at.lower(), guide_->sums);
    if (guide_->limits) {
        node.places = guide_->limits->places(at, node.box, cut.axis);
        const AxisLimits& limits = guide_->limits->across(cut.axis);
        bracket.lower = limits.nearest(bracket.lower, node.places.first, node.places.last);
        bracket.upper = limits.nearest(bracket.upper, bracket.lower, node.places.last);
    } else {
        bracket = points_.interval(at.node);
        bracket.lower = std::max(bracket.lower, -std::numeric_limits<double>::max());
        // Whole intervals take 1 % more rounds; 1.5 % more points move from earlier cuts.
        const double missing = missing_below(at, node.weight, node.below);
        if (missing > 0) bracket.lower = std::max(bracket.lower, cut.at[cut.axis]);
        if (missing < 0)
            bracket.upper = std::min(bracket.upper, std::nextafter(cut.at[cut.axis], infinity));
    }
    node.search = search_across(cut.axis, bracket, node.weight);
}

/// Returns intervals in which the cuts are looked for first. Limits may move cuts anywhere.
std::vector<Bracket> TreeSearch::intervals() const {
    std::vector<Bracket> found(guide_->cuts.tree.size(), {-infinity, infinity});
    const auto find = [&](const auto& self, const Descent& at, int depth, double shifted) -> void {
        if (at.is_part()) return;
        const double share = tree_.rule.share_below(at);
        const double weight = guide_->is_counted
                                  ? weight_of(at, guide_->sums)
                                  : tree_.rule.weight_per_size * tree_.rule.size_of(at);
        if (share > 0 && share < 1 && !are_few(weight))
            found[at.node] = interval_of(at, depth, shifted);
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
    const auto sums = guide_->sums;
    const double in_half = guide_->is_counted ? expected_error(depth) * weight_of(at, sums) : 0;
    if (in_half > 0) {
        const bool stays = shifted == 0 && tree_.rule.may_stay(at, sums);
        const double missing =
            stays ? 0 : missing_below(at, weight_of(at, sums), weight_of(at.lower(), sums));
        const double open = stays ? 0 : shifted / 2 / in_half + least;
        const auto widths = [&](double there) {
            return std::min(open + caution * std::max(there, 0.0) / in_half,
                            1 / expected_error(depth));  // holds all weight
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

/// Returns the weight missing below a node's cut; 0 if the present weight is not known.
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
        node.entries.insert(node.entries.end(), next->begin(), next->end());
        ++next;
    }
}

/// Takes the weights of a node's parts over all ranks. Returns whether its cut may stay.
bool TreeSearch::take_sums(Node& node, std::span<const double> sums) const {
    std::ranges::copy(sums, guide_->sums.begin() + node.at.first_part);
    node.below = weight_of(node.at.lower(), guide_->sums);
    return tree_.rule.may_stay(node.at, guide_->sums);
}

}  // namespace rrcb
