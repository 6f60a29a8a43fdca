#include "refinement/region_search.hpp"

#include "bisection/axis_choice.hpp"
#include "bisection/bisection.hpp"
#include "cuts/owned_cuts.hpp"
#include "cuts/part_share.hpp"
#include "refinement/sample.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Box of the entries of a fragment.
Box box_of(const Fragment& fragment, const SortedPoints& points) {
    Box box = fragment.box;
    const auto d = static_cast<std::size_t>(points.dimension());
    for (std::size_t a = 0; a < d; ++a) {
        box.lower[a] = infinity;
        box.upper[a] = -infinity;
        for (LocalIndex i = fragment.begin; i < fragment.end; ++i) {
            box.lower[a] = std::min(box.lower[a], points.coordinates[i * d + a]);
            box.upper[a] = std::max(box.upper[a], points.coordinates[i * d + a]);
        }
    }
    return box;
}

}  // namespace

int RegionTree::owner_of(const Descent& at) const {
    return rrcb::owner_of(at, num_parts, num_ranks);
}

RegionSearch::RegionSearch(const RegionTree& tree, int rank, const Regions& regions,
                           SortedPoints&& points, std::span<Part> parts)
    : tree_(tree),
      rank_(rank),
      dimension_(regions.cuts.dimension),
      points_(std::move(points)),
      parts_(parts) {
    const PartRange own = parts_on(rank, tree.num_parts, tree.num_ranks);
    first_own_ = own.first;
    end_own_ = own.end;
    all_sizes_ = tree.part_sizes.empty()
                     ? tree.num_parts
                     : std::accumulate(tree.part_sizes.begin(), tree.part_sizes.end(), 0.0);
    tree_.rule.weight_per_size = tree.weight / all_sizes_;
    // A region has one part more than another at most.
    const auto most_parts = static_cast<std::size_t>(tree.num_parts / regions.cuts.num_parts) + 1;
    if (tree.part_sizes.empty() && tree.ones.empty() && !tree.rule.is_exact) {
        ones_.assign(most_parts, 1.0);
        tree_.ones = ones_;
    }
    std::vector<Fragment> fragments = cell_fragments(points_);
    for (Fragment& fragment : fragments) fragment.box = box_of(fragment, points_);
    enter_region(regions, root_of(regions.cuts), {0, 0, tree.num_parts}, std::move(fragments),
                 regions.box);
}

double RegionSearch::share_below(const Descent& at) const {
    if (tree_.part_sizes.empty()) return 1.0 * lower_parts(at.num_parts) / at.num_parts;
    return rrcb::share_below(sizes_of(at));
}

/// Sizes of the parts of a node; of equal ones to a tolerance only.
std::span<const double> RegionSearch::sizes_of(const Descent& at) const {
    const auto count = static_cast<std::size_t>(at.num_parts);
    if (tree_.part_sizes.empty()) return tree_.ones.first(count);
    return tree_.part_sizes.subspan(static_cast<std::size_t>(at.first_part), count);
}

/// Target of the cut of a node, by the rule for a tree of its own.
CutTarget RegionSearch::target_of(const Descent& at, double weight) const {
    TargetRule rule = tree_.rule;
    // Of equal parts an exact cut asks only for how many are on each side.
    const int below = lower_parts(at.num_parts);
    const std::array<double, 2> sides{1.0 * below, 1.0 * (at.num_parts - below)};
    const bool by_sides = tree_.part_sizes.empty() && rule.is_exact;
    rule.part_sizes = by_sides ? std::span<const double>(sides) : sizes_of(at);
    return rule.target_of({0, 0, static_cast<int>(rule.part_sizes.size())}, weight);
}

bool RegionSearch::holds_own_parts(const Descent& at) const {
    return at.first_part < end_own_ && first_own_ < at.first_part + at.num_parts;
}

/// Goes down the cuts between regions, which every rank knows.
void RegionSearch::enter_region(const Regions& regions, const Descent& region, const Descent& at,
                                std::vector<Fragment>&& fragments, const Box& box) {
    if (region.is_part())
        return enter(at, {std::move(fragments), box,
                          regions.weights[static_cast<std::size_t>(region.first_part)]});
    const Cut& cut = regions.cuts.tree[region.node];
    known_.push_back({at.node, cut});
    auto [lower, upper] = cut.divides != 0 ? split_by_parts(fragments, at.upper().first_part)
                                           : split_tightly(fragments, cut, {});
    enter_region(regions, region.lower(), at.lower(), std::move(lower), box_below(box, cut));
    enter_region(regions, region.upper(), at.upper(), std::move(upper), box_above(box, cut));
}

/// Begins to search the cut of a node; goes on to its children where counting does not find it.
void RegionSearch::enter(const Descent& at, Content&& content) {
    if (content.fragments.empty() && !holds_own_parts(at)) return;
    if (at.is_part() && content.is_counted && !is_tiny(at)) return end_at_part(at, content);
    const double share = at.is_part() ? 1 : share_below(at);
    if (at.is_part() || (content.weight > 0 && share > 0 && share < 1)) {
        // A vector that is moved keeps its entries where they are.
        const LocalSearch local(content.fragments, points_);
        const CutSearch search = first_search(at, content.box, content.weight);
        nodes_.push_back({at, std::move(content), search, local});
        return;
    }
    // Nothing lies on a side without size, and what weighs nothing lies below.
    const bool is_below = share > 0;
    const int axis = tree_.cut_axes.empty() ? 0 : tree_.cut_axes[at.node];
    divide(at, content, plane(axis, is_below ? infinity : -infinity), {},
           is_below ? content.weight : 0);
}

/// Goes on below a cut.
void RegionSearch::divide(const Descent& at, const Content& content, const Cut& cut, const Lot& lot,
                          double below) {
    known_.push_back({at.node, cut});
    auto [lower, upper] = split_tightly(content.fragments, cut, lot);
    // A side of a lot that is divided may weigh up to a point more or less than asked for, which
    // the next count tells; until then the node's weight is a bound.
    const bool divides_lot = lot.below > 0;
    const bool is_counted = content.is_counted && !divides_lot;
    const double above = divides_lot ? content.weight : content.weight - below;
    if (divides_lot) below = content.weight;
    enter(at.lower(), {std::move(lower), box_below(content.box, cut), below, is_counted});
    enter(at.upper(), {std::move(upper), box_above(content.box, cut), above, is_counted});
}

/// Splits fragments whose boxes touch their entries; so do those of the halves.
RegionSearch::Halves RegionSearch::split_tightly(const std::vector<Fragment>& fragments,
                                                 const Cut& cut, const Lot& lot) {
    Halves halves = split(fragments, cut, lot, points_);
    const auto axis = static_cast<std::size_t>(cut.axis);
    for (auto* half : {&halves.first, &halves.second})
        for (Fragment& fragment : *half)
            if (fragment.box.lower[axis] == cut.at[axis] ||
                fragment.box.upper[axis] == cut.at[axis])
                fragment.box = box_of(fragment, points_);
    return halves;
}

/// The same by the parts that points are in.
RegionSearch::Halves RegionSearch::split_by_parts(const std::vector<Fragment>& fragments,
                                                  Part first_above) {
    Halves halves = rrcb::split_by_parts(fragments, first_above, parts_, points_);
    for (auto* half : {&halves.first, &halves.second})
        for (Fragment& fragment : *half) fragment.box = box_of(fragment, points_);
    return halves;
}

void RegionSearch::end_at_part(const Descent& at, const Content& content) {
    write_part(content.fragments, at.first_part, points_, parts_);
    if (tree_.owner_of(at) != rank_) return;
    imbalance_ = std::max(imbalance_, over_ideal(content.weight, tree_.weight, ideal_share(at)));
}

/// Share of the weight that a part should have.
double RegionSearch::ideal_share(const Descent& at) const {
    return (tree_.part_sizes.empty() ? 1.0 : sizes_of(at)[0]) / all_sizes_;
}

/// Whether the round-off of what a cut left over may be much of what a part should weigh, so that
/// only its points tell how heavy it is.
bool RegionSearch::is_tiny(const Descent& part) const {
    constexpr double least_share = 0x1p-20;
    const double share = tree_.part_sizes.empty() ? 1 : ideal_share(part);
    return share > 0 && share < least_share;
}

/// The search for the cut of a node in a box before anything is counted, or to weigh a part.
CutSearch RegionSearch::first_search(const Descent& at, const Box& box, double weight) const {
    CutSearch search;
    search.cut.axis = tree_.cut_axes.empty() || at.is_part()
                          ? longest_axis(box, dimension_, tree_.share_of_longest)
                          : tree_.cut_axes[at.node];
    search.num_axes = tree_.plain_cuts ? 1 : dimension_;
    search.divides = tree_.divides_coincident && !tree_.plain_cuts ? 1 : 0;
    search.cut.at.fill(-infinity);
    const auto axis = static_cast<std::size_t>(search.cut.axis);
    search.lower = box.lower[axis];
    search.upper = std::nextafter(box.upper[axis], infinity);
    search.quantum = quantum_for(weight);
    return search;
}

void RegionSearch::ask(Butterfly& butterfly) const {
    std::vector<double> payload;
    for (const Node& node : nodes_) {
        payload.clear();
        if (!node.content.fragments.empty()) count(node, payload);
        butterfly.add(key_of(node.at), tree_.owner_of(node.at), payload);
    }
}

/// Appends what this rank has to tell of a node.
void RegionSearch::count(const Node& node, std::vector<double>& payload) const {
    if (node.divides_lot || node.at.is_part()) {
        const auto& fragments = node.content.fragments;
        const double weight = node.divides_lot ? weight_at(node.search.cut, fragments, points_)
                                               : weight_of(fragments);
        const double quantum = node.divides_lot ? node.search.quantum : 0;
        const double told[] = {mark_of_weight, 1.0 * rank_, rounded_to(quantum, weight)};
        if (weight > 0) payload.assign(std::begin(told), std::end(told));
        return;
    }
    if (node.search.stage == CutSearch::gathering) {
        node.local.append_candidates(mark_of_candidate, payload);
        return;
    }
    payload.resize(1 + layout_.length());
    payload[0] = mark_of_histogram;
    const std::span<double> histogram = std::span(payload).subspan(1);
    if (node.search.stage == CutSearch::sampling) {
        node.local.add_candidates(rank_, clear_to_sample(dimension_, histogram));
    } else {
        clear_histogram(histogram);
        node.local.count(node.search, layout_, histogram);
    }
}

void RegionSearch::join(std::span<const double> a, std::span<const double> b,
                        std::vector<double>& joined) {
    joined.insert(joined.end(), a.begin(), a.end());
    if (a.empty() || b.empty() || (a[0] == b[0] && a[0] != mark_of_histogram)) {
        joined.insert(joined.end(), b.begin(), b.end());
    } else if (a[0] == b[0]) {
        join_histograms(b.subspan(1), std::span(joined).last(a.size() - 1));
    }
    // What does not fit together was told after a failure, of which all hear at the end of the
    // pass.
}

void RegionSearch::follow(const Butterfly& butterfly) {
    std::vector<Node> before = std::exchange(nodes_, {});
    nodes_.reserve(before.size());
    RecordReader answers = butterfly.answers().read();
    Record answer;
    // Both ascend. Answers to others may have gone through this rank.
    for (Node& node : before) {
        while (!answers.at_end() && (answer.payload.empty() || answer.key < key_of(node.at)))
            answer = answers.next();
        const bool is_answered = !answer.payload.empty() && answer.key == key_of(node.at);
        if (is_answered) {
            follow(std::move(node), answer.payload);
        } else {
            nodes_.push_back(std::move(node));
        }
    }
}

/// Follows the decision on a node: searches it further, or goes on with its children.
void RegionSearch::follow(Node&& node, std::span<const double> payload) {
    Answer answer;
    std::memcpy(static_cast<void*>(&answer), payload.data(), sizeof answer);
    const CutSearch search = std::exchange(node.search, answer.search);
    node.content.box = answer.box;
    node.content.weight = answer.weight;
    if (node.at.is_part()) return end_at_part(node.at, node.content);
    if (search.stage == CutSearch::over_fragments) node.content.is_counted = true;
    const bool is_done = node.search.stage == CutSearch::done;
    const bool has_lot = is_done && node.search.lot_below > 0;
    if (is_done && has_lot == node.divides_lot) return end_at_cut(node, answer);
    node.divides_lot = has_lot;
    if (search.stage == CutSearch::sampling)
        node.local.take_splitters(
            splitters_of(positions_in(payload.subspan(Answer::length()), dimension_),
                         order_of(node.search), layout_));
    if (node.search.stage != CutSearch::over_fragments)
        node.local.keep_chosen(search, node.search, layout_);
    nodes_.push_back(std::move(node));
}

/// Goes on below the cut that was found. The points of a lot form one row over all ranks.
void RegionSearch::end_at_cut(const Node& node, const Answer& answer) {
    Cut cut = node.search.cut;
    Lot lot;
    if (node.divides_lot) {
        cut.divides = 1;
        lot.below = node.search.lot_below;
        lot.before = rank_ < answer.dividing_rank   ? -infinity
                     : rank_ > answer.dividing_rank ? infinity
                                                    : answer.lot_before;
    }
    divide(node.at, node.content, cut, lot, node.search.below);
}

Cuts RegionSearch::cuts() const {
    std::vector<KnownCut> known = known_;
    std::ranges::sort(known, {}, &KnownCut::node);
    Cuts cuts{dimension_, tree_.num_parts, {}, {}};
    for (const KnownCut& one : known) {
        cuts.tree.push_back(one.cut);
        cuts.nodes.push_back(static_cast<std::int32_t>(one.node));
    }
    return cuts;
}

}  // namespace rrcb
