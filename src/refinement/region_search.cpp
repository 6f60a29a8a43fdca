#include "refinement/region_search.hpp"

#include "bisection/axis_choice.hpp"
#include "refinement/sample.hpp"

#include <rrcb/plan.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <ranges>
#include <tuple>
#include <utility>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The parts that a rank holds.
std::pair<Part, Part> own_parts(int rank, int num_parts, int num_ranks) {
    const auto numbers = std::views::iota(Part{0}, Part{num_parts});
    const auto ranks = [&](Part part) { return ranks_of_part(part, num_parts, num_ranks); };
    const auto end_rank = [&](Part part) { return ranks(part).first_rank + ranks(part).count; };
    const auto first_rank = [&](Part part) { return ranks(part).first_rank; };
    const auto first = std::ranges::upper_bound(numbers, rank, {}, end_rank);
    const auto end = std::ranges::upper_bound(numbers, rank, {}, first_rank);
    return {static_cast<Part>(first - numbers.begin()), static_cast<Part>(end - numbers.begin())};
}

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
    return ranks_of_part(at.first_part, num_parts, num_ranks).first_rank;
}

RegionSearch::RegionSearch(const RegionTree& tree, int rank, const Regions& regions,
                           SortedPoints&& points, std::span<Part> parts)
    : tree_(tree),
      rank_(rank),
      dimension_(regions.cuts.dimension),
      points_(std::move(points)),
      parts_(parts) {
    std::tie(first_own_, end_own_) = own_parts(rank, tree.num_parts, tree.num_ranks);
    all_sizes_ = tree.part_sizes.empty()
                     ? tree.num_parts
                     : std::accumulate(tree.part_sizes.begin(), tree.part_sizes.end(), 0.0);
    tree_.rule.weight_per_size = tree.weight / all_sizes_;
    // A region has one part more than another at most.
    const auto most_parts = static_cast<std::size_t>(tree.num_parts / regions.cuts.num_parts) + 1;
    if (tree.part_sizes.empty()) ones_.assign(most_parts, 1.0);
    std::vector<Fragment> fragments = cell_fragments(points_);
    for (Fragment& fragment : fragments) fragment.box = box_of(fragment, points_);
    enter_region(regions, root_of(regions.cuts), {0, 0, tree.num_parts}, std::move(fragments),
                 regions.box);
}

/// The rule for a node that is the root of its own tree.
TargetRule RegionSearch::rule_for(const Descent& at) const {
    TargetRule rule = tree_.rule;
    const auto count = static_cast<std::size_t>(at.num_parts);
    rule.part_sizes =
        tree_.part_sizes.empty()
            ? std::span<const double>(ones_).first(count)
            : tree_.part_sizes.subspan(static_cast<std::size_t>(at.first_part), count);
    return rule;
}

bool RegionSearch::holds_own_parts(const Descent& at) const {
    return at.first_part < end_own_ && first_own_ < at.first_part + at.num_parts;
}

/// Goes down the cuts between regions, which every rank knows.
void RegionSearch::enter_region(const Regions& regions, const Descent& region, const Descent& at,
                                std::vector<Fragment>&& fragments, const Box& box) {
    if (region.is_part())
        return enter(at, std::move(fragments), box,
                     regions.weights[static_cast<std::size_t>(region.first_part)]);
    const Cut& cut = regions.cuts.tree[region.node];
    known_.push_back({at.node, cut});
    auto [lower, upper] = split_tightly(fragments, cut);
    enter_region(regions, region.lower(), at.lower(), std::move(lower), box_below(box, cut));
    enter_region(regions, region.upper(), at.upper(), std::move(upper), box_above(box, cut));
}

/// Begins to search the cut of a node; goes on to its children where counting does not find it.
void RegionSearch::enter(const Descent& at, std::vector<Fragment>&& fragments, const Box& box,
                         double weight) {
    if (fragments.empty() && !holds_own_parts(at)) return;
    if (at.is_part()) return end_at_part(at, fragments, weight);
    const double share = rule_for(at).share_below({0, 0, at.num_parts});
    if (weight > 0 && share > 0 && share < 1) {
        // A vector that is moved keeps its entries where they are.
        const LocalSearch local(fragments, points_);
        nodes_.push_back({at, std::move(fragments), box, weight, first_search(box, weight), local});
        return;
    }
    // Nothing lies on a side without size, and what weighs nothing lies below.
    const bool is_below = share > 0;
    divide(at, fragments, box, plane(0, is_below ? infinity : -infinity), weight,
           is_below ? weight : 0);
}

/// Goes on below a cut.
void RegionSearch::divide(const Descent& at, const std::vector<Fragment>& fragments, const Box& box,
                          const Cut& cut, double weight, double below) {
    known_.push_back({at.node, cut});
    auto [lower, upper] = split_tightly(fragments, cut);
    enter(at.lower(), std::move(lower), box_below(box, cut), below);
    enter(at.upper(), std::move(upper), box_above(box, cut), weight - below);
}

/// Splits fragments whose boxes touch their entries; so do those of the halves.
std::pair<std::vector<Fragment>, std::vector<Fragment>> RegionSearch::split_tightly(
    const std::vector<Fragment>& fragments, const Cut& cut) {
    auto halves = split(fragments, cut, {}, points_);
    const auto axis = static_cast<std::size_t>(cut.axis);
    for (auto* half : {&halves.first, &halves.second})
        for (Fragment& fragment : *half)
            if (fragment.box.lower[axis] == cut.at[axis] ||
                fragment.box.upper[axis] == cut.at[axis])
                fragment.box = box_of(fragment, points_);
    return halves;
}

void RegionSearch::end_at_part(const Descent& at, const std::vector<Fragment>& fragments,
                               double weight) {
    write_part(fragments, at.first_part, points_, parts_);
    if (!(weight > 0) || tree_.owner_of(at) != rank_) return;
    const double share = rule_for(at).part_sizes[0] / all_sizes_;
    imbalance_ = std::max(imbalance_, weight / tree_.weight / share);
}

/// The search in a box before anything is counted.
CutSearch RegionSearch::first_search(const Box& box, double weight) const {
    CutSearch search;
    search.cut.axis = longest_axis(box, dimension_, tree_.share_of_longest);
    search.num_axes = tree_.plain_cuts ? 1 : dimension_;
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
        if (!node.fragments.empty()) count(node, payload);
        butterfly.add(node.at.node, tree_.owner_of(node.at), payload);
    }
}

/// Appends what this rank has to tell of a node.
void RegionSearch::count(const Node& node, std::vector<double>& payload) const {
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
    if (a.empty() || b.empty() || (a[0] == mark_of_candidate && b[0] == mark_of_candidate)) {
        joined.insert(joined.end(), b.begin(), b.end());
    } else if (a[0] == b[0]) {
        join_histograms(b.subspan(1), std::span(joined).last(a.size() - 1));
    }
    // What does not fit together was told after a failure, of which all hear at the end of the
    // pass.
}

void RegionSearch::follow(const Butterfly& butterfly) {
    std::vector<Node> before = std::exchange(nodes_, {});
    RecordReader answers = butterfly.answers().read();
    Record answer;
    // Both ascend. Answers to others may have gone through this rank.
    for (Node& node : before) {
        while (!answers.at_end() && (answer.payload.empty() || answer.key < node.at.node))
            answer = answers.next();
        const bool is_answered = !answer.payload.empty() && answer.key == node.at.node;
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
    node.box = answer.box;
    node.weight = answer.weight;
    if (node.search.stage == CutSearch::done)
        return divide(node.at, node.fragments, node.box, node.search.cut, node.weight,
                      node.search.below);
    if (search.stage == CutSearch::sampling)
        node.local.take_splitters(
            splitters_of(positions_in(payload.subspan(Answer::length()), dimension_),
                         order_of(node.search), layout_));
    if (node.search.stage != CutSearch::over_fragments)
        node.local.keep_chosen(search, node.search, layout_);
    nodes_.push_back(std::move(node));
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
