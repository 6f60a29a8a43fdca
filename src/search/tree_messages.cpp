// The records that ranks send to the owners of nodes, and how they follow the answers.
#include "arithmetic/quantum.hpp"
#include "search/doubles.hpp"
#include "search/gap.hpp"
#include "search/tree_search.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace rrcb {

void TreeSearch::ask(Butterfly& butterfly) {
    std::vector<double> payload;
    for (const Node& node : nodes_) {
        payload.clear();
        count(node, payload);
        butterfly.add(key_of(node.at), owner_of(node.at), payload);
    }
}

/// Appends the record of this rank for a node.
void TreeSearch::count(const Node& node, std::vector<double>& payload) {
    if (node.question == Question::parts) return count_parts(node, payload);
    const auto& fragments = node.content.fragments;
    if (fragments.empty()) return;
    if (node.question == Question::lot) return add_lot(node, payload);
    if (node.at.is_part()) {
        const double weight = weight_of(fragments);
        if (weight > 0) payload = {mark_of_weights, 1.0 * rank_, weight};
        return;
    }
    if (node.search.stage == CutSearch::centring) return find_gap(node, payload);
    if (node.search.stage == CutSearch::gathering) {
        payload.push_back(mark_of_candidates);
        node.local.append_candidates(payload);
        return;
    }
    payload.resize(1 + layout_.length());
    payload[0] = mark_of_histogram;
    const std::span<double> histogram = std::span(payload).subspan(1);
    clear_histogram(histogram);
    node.local.count(node.search, layout_, histogram);
}

/// Appends this rank's points of a lot.
void TreeSearch::add_lot(const Node& node, std::vector<double>& payload) const {
    LotRecord record{1.0 * rank_, points_at(node.search.cut, node.content.fragments, points_)};
    if (!(record.points.weight > 0)) return;
    record.points.weight = rounded_to(node.search.quantum, record.points.weight);
    payload.push_back(mark_of_weights);
    append(record, payload);
}

/// Appends the gap of this rank's points around the known cut of a node.
void TreeSearch::find_gap(const Node& node, std::vector<double>& payload) {
    const Cut& cut = node.search.cut;
    const auto& fragments = node.content.fragments;
    Gap gap;
    gap.fill(-std::numeric_limits<double>::infinity());
    narrow(cut, fragments, points_, gap);
    // Only cells in this gap can narrow it further, so the second pass is short.
    sort_between(gap[1], -gap[0], cut.axis, node.content);
    narrow(cut, fragments, points_, gap);
    payload.push_back(mark_of_gap);
    payload.insert(payload.end(), gap.begin(), gap.begin() + 2 * node.search.num_axes);
}

void TreeSearch::join(std::span<const double> a, std::span<const double> b,
                      std::vector<double>& joined) {
    const bool is_alike = a.empty() || b.empty() || a[0] == b[0];
    const bool adds = !a.empty() && !b.empty() && a.size() == b.size() &&
                      (a[0] == mark_of_histogram || a[0] == mark_of_parts || a[0] == mark_of_gap);
    joined.insert(joined.end(), a.begin(), a.end());
    // Records differ only because of a failure, which all ranks learn of after the pass.
    if (!is_alike) return;
    const auto sum = std::span(joined).last(adds ? a.size() - 1 : 0);
    if (!adds) {
        const auto records = a.empty() || b.empty() ? b : b.subspan(1);
        joined.insert(joined.end(), records.begin(), records.end());
    } else if (a[0] == mark_of_histogram) {
        join_histograms(b.subspan(1), sum);
    } else if (a[0] == mark_of_gap) {
        std::ranges::transform(sum, b.subspan(1), sum.begin(),
                               [](double x, double y) { return std::max(x, y); });
    } else {
        std::ranges::transform(sum, b.subspan(1), sum.begin(), std::plus<>());
    }
}

void TreeSearch::follow(const Butterfly& butterfly) {
    std::vector<Node> before = std::exchange(nodes_, {});
    nodes_.reserve(before.size());
    RecordReader answers = butterfly.answers().read();
    Record answer;
    // Both ascend. Answers for other ranks may have passed through this one.
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

/// Follows the answer of the owner of a node.
void TreeSearch::follow(Node&& node, std::span<const double> payload) {
    const auto answer = read<Answer>(payload);
    const auto more = payload.subspan(sizeof answer / sizeof(double));
    if (node.question == Question::parts) return take_sums(std::move(node), more);
    node.content.weight = answer.weight;
    if (node.at.is_part()) return end_at_part(node.at, node.content);
    if (node.question == Question::lot) {
        node.search = answer.search;
        return end_at_cut(std::move(node), read<LotAnswer>(more));
    }
    follow_search(std::move(node), answer.search, more);
}

/// Searches a node further, or goes on with its children.
void TreeSearch::follow_search(Node&& node, const CutSearch& next, std::span<const double> more) {
    const CutSearch before = std::exchange(node.search, next);
    if (before.stage == CutSearch::centring) return note(node.at.node, next.cut);
    if (before.stage == CutSearch::over_fragments) {
        node.content.is_counted = true;
        if (!is_central()) node.content.box = read<Box>(more);
    }
    if (next.stage == CutSearch::centring) {
        // The parts below do not depend on where in its gap the cut is.
        Node divided = node;
        nodes_.push_back(std::move(node));
        return end_at_cut(std::move(divided), {});
    }
    const bool is_done = next.stage == CutSearch::done;
    if (is_done && !(next.lot_below > 0)) return end_at_cut(std::move(node), {});
    const int axis = next.cut.axis;
    if (is_done) {
        node.question = Question::lot;
        sort_between(next.cut.at[axis], next.cut.at[axis], axis, node.content);
    } else if (before.stage == CutSearch::over_fragments) {
        sort_between(next.lower, next.upper, axis, node.content);
    }
    if (next.stage != CutSearch::over_fragments) node.local.keep_chosen(before, next, layout_);
    nodes_.push_back(std::move(node));
}

}  // namespace rrcb
