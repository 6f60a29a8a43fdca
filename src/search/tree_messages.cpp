// The records that ranks send to the owners of nodes, and how they follow the answers.
#include "arithmetic/infinity.hpp"
#include "arithmetic/quantum.hpp"
#include "passes/histogram.hpp"
#include "search/doubles.hpp"
#include "search/tree_search.hpp"

#include <algorithm>
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
    if (node.search.stage == CutSearch::centring) {
        if (std::ranges::max(node.gap) == -infinity) return;
        payload.push_back(mark_of_gap);
        payload.insert(payload.end(), node.gap.begin(),
                       node.gap.begin() + std::ptrdiff_t{2} * node.search.num_axes);
        return;
    }
    const bool is_empty =
        node.content.entries.empty() && node.below_here.count + node.above_here.count == 0;
    if (is_empty) return;
    if (node.search.stage == CutSearch::dividing || node.at.is_part())
        return add_lot(node, payload);
    if (node.search.stage == CutSearch::gathering) {
        payload.push_back(mark_of_candidates);
        points_.append(node.candidates, payload);
        return;
    }
    payload.resize(1 + layout_of(node.search).length());
    payload[0] = mark_of_histogram;
    count_points(node, std::span(payload).subspan(1));
    if (counts_all_axes(node)) count_other_axes(node, payload);
    if (!node.counts_parts) return;
    const auto weights = points_.part_weights(node.at, node.content.entries);
    payload.insert(payload.end(), weights.begin(), weights.end());
}

/// Counts this rank's points in the bins of a search.
void TreeSearch::count_points(const Node& node, std::span<double> histogram) const {
    const CutSearch& search = node.search;
    const bool is_first = search.stage == CutSearch::over_points;
    const HistogramLayout layout = layout_of(search);
    clear_histogram(histogram);
    rrcb::count(points_.points(), is_first ? node.content.entries : node.candidates,
                current_axis(search), bins_of(search, layout), layout, histogram);
    if (is_first && is_central()) {
        count_settled(node.below_here, guide_->box, 0, layout, histogram);
        count_settled(node.above_here, guide_->box, layout.num_bins + 1, layout, histogram);
    }
    if (layout.is_weighted) round_weights(search.quantum, layout, histogram);
}

/// Appends this rank's points of a lot or a part.
void TreeSearch::add_lot(const Node& node, std::vector<double>& payload) const {
    LotRecord record{1.0 * rank_, {points_.weight_of(node.content.entries)}};
    if (!node.at.is_part())
        record.points = points_.points_at(node.search.cut, node.content.entries);
    if (!(record.points.weight > 0)) return;
    if (!node.at.is_part())
        record.points.weight = rounded_to(node.search.quantum, record.points.weight);
    payload.push_back(mark_of_weights);
    append(record, payload);
}

void TreeSearch::join(std::span<const double> a, std::span<const double> b,
                      std::vector<double>& joined) {
    const auto add = [&](std::span<const double> more) {
        joined.insert(joined.end(), more.begin(), more.end());
    };
    add(a);
    if (a.empty() || b.empty()) return add(b);
    // Records differ only because of a failure, which all ranks learn of after the pass.
    if (a[0] != b[0]) return;
    const auto other = b.subspan(1);
    if (a[0] == mark_of_candidates || a[0] == mark_of_weights) return add(other);
    if (a.size() != b.size()) return;
    const auto here = std::span(joined).last(other.size());
    if (a[0] == mark_of_histogram) {
        join_histograms(other, here);
    } else {
        std::ranges::transform(here, other, here.begin(),
                               [](double x, double y) { return std::max(x, y); });
    }
}

void TreeSearch::follow(const Butterfly& butterfly) {
    std::deque<Node> before = std::exchange(nodes_, {});
    RecordReader answers = butterfly.answers().read();
    Record answer;
    // Both ascend. Answers for other ranks may have passed through this one.
    for (; !before.empty(); before.pop_front()) {
        Node& node = before.front();
        while (!answers.at_end() && (answer.payload.empty() || answer.key < key_of(node.at)))
            answer = answers.next();
        const bool is_answered = !answer.payload.empty() && answer.key == key_of(node.at);
        if (is_answered) {
            follow(std::move(node), answer.payload);
        } else {
            nodes_.push_back(std::move(node));
        }
    }
    if (is_central()) collect_more();
}

/// Follows the answer of the owner of a node.
void TreeSearch::follow(Node&& node, std::span<const double> payload) {
    const auto answer = read<Answer>(payload);
    const auto more = payload.subspan(sizeof answer / sizeof(double));
    node.content.weight = answer.weight;
    if (node.at.is_part()) return weigh_part(node.at, node.content);
    if (node.search.stage == CutSearch::dividing) {
        node.search = answer.search;
        return end_at_cut(std::move(node), read<LotAnswer>(more));
    }
    if (std::exchange(node.counts_parts, false) && take_sums(node, more)) {
        node.content.are_parts_counted = true;
        return enter(node.at, std::move(node.content));
    }
    follow_search(std::move(node), answer.search, more);
}

/// Searches a node further, or goes on with its children.
void TreeSearch::follow_search(Node&& node, const CutSearch& next, std::span<const double> more) {
    CutSearch before = std::exchange(node.search, next);
    if (before.stage == CutSearch::centring) return note(node.at.node, next.cut);
    if (before.stage == CutSearch::over_points) {
        node.content.is_counted = true;
        if (!is_central()) {
            turn(before, node.content.box, next.cut.axis);
            node.content.box = read<Box>(more);
        }
    }
    if (next.stage == CutSearch::centring) {
        // The parts below do not depend on where in its gap the cut is.
        Node centred{node.at, {}, next};
        centred.gap = points_.gap_about(node.at, node.content.entries, next.cut);
        nodes_.push_back(std::move(centred));
        return end_at_cut(std::move(node), {});
    }
    if (next.stage == CutSearch::done) return end_at_cut(std::move(node), {});
    const bool narrows =
        next.stage == CutSearch::over_candidates || next.stage == CutSearch::gathering;
    if (narrows) keep_chosen(before, node);
    nodes_.push_back(std::move(node));
}

/// Keeps the points in the slot that the owner chose. A slot beyond the interval of the cut has
/// points that are to be collected.
void TreeSearch::keep_chosen(const CutSearch& before, Node& node) {
    const int slot = node.search.chosen;
    const HistogramLayout layout = layout_of(before);
    const Bins bins = bins_of(before, layout);
    const bool is_first = before.stage == CutSearch::over_points;
    node.candidates =
        between(slot == 0 ? -infinity : bins.edge(slot - 1),
                slot > layout.num_bins ? infinity : bins.edge(slot), current_axis(before),
                is_first ? node.content.entries : node.candidates, points_.points());
    if (!is_central() || !is_first) return;
    node.is_wide = (slot == 0 && node.below_here.count > 0) ||
                   (slot > layout.num_bins && node.above_here.count > 0);
}

}  // namespace rrcb
