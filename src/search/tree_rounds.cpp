// One round of a search: the ranks send records to the owners of nodes, the owners decide, and the
// ranks follow the answers.
#include "arithmetic/infinity.hpp"
#include "arithmetic/part_share.hpp"
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

/// Returns true if this rank has points in a node.
bool TreeSearch::has_points(const Node& node) const {
    return node.settled_below.count + node.settled_above.count > 0 || !open_.is_empty(node.at);
}

/// Appends this rank's record about a node.
void TreeSearch::count(const Node& node, std::vector<double>& payload) const {
    if (node.search.stage == CutSearch::centring) {
        if (std::ranges::max(node.gap) == -infinity) return;
        payload.push_back(mark_of_gap);
        payload.insert(payload.end(), node.gap.begin(),
                       node.gap.begin() + std::ptrdiff_t{2} * node.search.num_axes);
        return;
    }
    if (!has_points(node)) return;
    if (node.search.stage == CutSearch::dividing || node.at.is_part())
        return add_lot(node, payload);
    if (node.search.stage == CutSearch::gathering) {
        payload.push_back(mark_of_candidates);
        open_.take(node.at, payload);
        return;
    }
    payload.resize(1 + layout_.length());
    payload[0] = mark_of_histogram;
    count_points(node, std::span(payload).subspan(1));
    if (counts_all_axes(node)) count_other_axes(node, payload);
}

/// Adds this rank's points to the bins of a search.
void TreeSearch::count_points(const Node& node, std::span<double> histogram) const {
    const CutSearch& search = node.search;
    clear_histogram(histogram);
    open_.count(node.at, current_axis(search), bins_of(search, layout_), layout_, histogram);
    if (guide_ && search.stage == CutSearch::over_points) {
        count_settled(node.settled_below, guide_->box, 0, layout_, histogram);
        count_settled(node.settled_above, guide_->box, layout_.num_bins + 1, layout_, histogram);
    }
    round_weights(search.quantum, layout_, sums_in(histogram));
}

/// Appends the weight of this rank's points in a lot or in a part. A lot is a set of coincident
/// points that a cut divides.
void TreeSearch::add_lot(const Node& node, std::vector<double>& payload) const {
    const bool is_part = node.at.is_part();
    LotRecord record{1.0 * rank_, is_part ? PointsInLot{open_.weight_at(node.at)}
                                          : open_.lot(node.at, node.search.cut)};
    if (!(record.points.weight > 0)) return;
    if (!is_part) record.points.weight = rounded_to(node.search.quantum, record.points.weight);
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
    // Records of one node have the same kind, except after a failure, which all ranks learn of
    // after the pass.
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

namespace {

/// Returns the box of the points in a histogram.
Box box_in(std::span<const double> histogram) {
    Box box;
    for (std::size_t a = 0; a < max_dimension; ++a) {
        box.lower[a] = -histogram[a];
        box.upper[a] = histogram[max_dimension + a];
    }
    return box;
}

/// Returns the records of the ranks, in order of ranks.
template <class Record>
std::vector<Record> records_in(std::span<const double> payload) {
    std::vector<Record> records;
    for (std::size_t k = 1; k < payload.size(); k += sizeof(Record) / sizeof(double))
        records.push_back(read<Record>(payload.subspan(k)));
    std::ranges::sort(records, {}, &Record::rank);
    return records;
}

}  // namespace

void TreeSearch::decide(Butterfly& butterfly) {
    GlobalCount num_gathered = 0;
    auto node = nodes_.begin();
    // Records and nodes are both in ascending order, and the owner of a node takes part in it.
    butterfly.owned().for_each([&](const Record& record) {
        node = std::ranges::find(node, nodes_.end(), record.key,
                                 [](const Node& one) { return key_of(one.at); });
        if (node == nodes_.end()) return;
        CutSearch decided = node->at.is_part() ? node->search : decide_on(*node, record.payload);
        if (decided.stage == CutSearch::gathering) {
            // If one rank would receive too many candidates, the remaining searches count once more
            // instead.
            const GlobalCount more = node->target.num_candidates;
            const bool fits = num_gathered + more <= most_gathered_at_once;
            num_gathered += fits ? more : 0;
            if (!fits) decided.stage = CutSearch::over_candidates;
        }
        butterfly.answer(record.key, answer_to(record, *node, decided));
    });
}

std::vector<double> TreeSearch::answer_to(const Record& record, const Node& node,
                                          const CutSearch& decided) const {
    std::vector<double> answer;
    Answer told{decided, node.weight};
    if (node.at.is_part()) {
        told.weight = 0;
        for (const auto& [rank, points] : records_in<LotRecord>(record.payload))
            told.weight += points.weight;
    }
    append(told, answer);
    if (node.search.stage == CutSearch::dividing) {
        append(node.lot, answer);
    } else if (node.search.stage == CutSearch::over_points && !guide_) {
        append(node.found, answer);
    }
    return answer;
}

/// Finds the first rank of which points of a lot are above the cut. If all points of the lot are on
/// one side, the cut does not divide them: a look-up of a divided position always gives the upper
/// side.
CutSearch TreeSearch::decide_on_lot(Node& node, std::span<const double> payload) const {
    CutSearch search = node.search;
    search.stage = CutSearch::done;
    const std::vector<LotRecord> row = records_in<LotRecord>(payload);
    Lot lot = lot_at(node.at, search);
    const auto dividing = std::ranges::find_if(row, [&](const LotRecord& record) {
        if (lot.is_above(record.points.before_last, record.points.last)) return true;
        lot.before += record.points.weight;
        return false;
    });
    const bool is_above =
        row.empty() || (dividing == row.begin() && lot.is_above(0, row.front().points.first));
    const bool is_below = !is_above && dividing == row.end();
    if (is_above || is_below) search.lot_below = 0;
    if (is_below) {
        search.found_below += lot.before;
        move_behind(search);
    }
    if (!is_above && !is_below) node.lot = {dividing->rank, lot.before};
    return search;
}

/// Advances a search with the joined records of all ranks. Empty records mean that the node has no
/// points.
CutSearch TreeSearch::decide_on(Node& node, std::span<const double> payload) {
    CutSearch search = node.search;
    if (search.stage == CutSearch::dividing) return decide_on_lot(node, payload);
    if (search.stage == CutSearch::centring) {
        search.stage = CutSearch::done;
        if (!payload.empty()) centre(search.cut, search.num_axes, payload.subspan(1));
        return search;
    }
    if (payload.empty()) {
        // The node has no points; its weight was only round-off.
        search.stage = CutSearch::done;
        if (guide_) search.cut = cut_unsearched(node, tree_.rule.share_below(node.at));
        node.weight = 0;
        return search;
    }
    const auto records = payload.subspan(1);
    bool is_centred = false;
    if (search.stage == CutSearch::over_points) {
        decide_by_first_count(node, records, search);
    } else if (search.stage == CutSearch::over_candidates) {
        decide_by_bins(search, node.target, layout_, records);
    } else {
        if (node.is_taken) frame(records, search);
        is_centred = decide_among(search, node.target, records, tree_.dimension);
    }
    if (search.stage != CutSearch::done) return search;
    if (search.lot_below > 0) {
        search.stage = CutSearch::dividing;
    } else if (tree_.centres_cuts && !is_centred) {
        search.stage = CutSearch::centring;
    }
    return search;
}

/// Sets the target of a node that has `count` points and whose weight is known.
void TreeSearch::aim(Node& node, GlobalCount count) const {
    node.target = tree_.rule.target_of(node.at, node.weight);
    node.target.places = node.places;
    node.target.divides = tree_.divides_coincident && !tree_.plain_cuts;
    if (node.target.places.all())
        node.target.counts = tree_.rule.count_limits(node.at, count, node.weight);
}

/// Sets the weight and box of the node from the first count, then decides.
void TreeSearch::decide_by_first_count(Node& node, std::span<const double> histogram,
                                       CutSearch& search) {
    node.weight = sum_of(weights_in(histogram, layout_));
    if (!guide_) node.found = box_in(histogram);
    aim(node, static_cast<GlobalCount>(sum_of(counts_in(histogram, layout_))));
    std::vector<double> along_axis;
    if (counts_all_axes(node)) histogram = along_axis = choose_axis(node, histogram, search);
    decide_by_bins(search, node.target, layout_, histogram);
}

void TreeSearch::follow(const Butterfly& butterfly) {
    std::deque<Node> before = std::exchange(nodes_, {});
    RecordReader answers = butterfly.answers().read();
    Record answer;
    // Nodes and answers are both in ascending order. Among them are answers for other ranks, which
    // this rank has passed on.
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
    widen();
}

/// Processes the answer of a node's owner.
void TreeSearch::follow(Node&& node, std::span<const double> payload) {
    const auto answer = read<Answer>(payload);
    const auto more = payload.subspan(sizeof answer / sizeof(double));
    node.weight = answer.weight;
    if (node.at.is_part()) return weigh_part(node);
    if (node.search.stage == CutSearch::dividing) {
        node.search = answer.search;
        return end_at_cut(std::move(node), read<LotAnswer>(more));
    }
    follow_search(std::move(node), answer.search, more);
}

/// Continues the search of a node, or continues with its children if the cut is found.
void TreeSearch::follow_search(Node&& node, const CutSearch& next, std::span<const double> more) {
    CutSearch before = std::exchange(node.search, next);
    if (before.stage == CutSearch::centring) return note(node.at, next.cut);
    if (before.stage == CutSearch::over_points) {
        node.is_counted = true;
        if (!guide_) {
            turn(before, node.box, next.cut.axis);
            node.box = read<Box>(more);
        }
    }
    if (next.stage == CutSearch::centring) {
        // Centring moves the cut within a gap without points, so the children need not wait for it.
        Node centred{.at = node.at, .search = next};
        centred.gap = open_.gap(node.at, next.cut);
        nodes_.push_back(std::move(centred));
        return end_at_cut(std::move(node), {});
    }
    if (next.stage == CutSearch::done) return end_at_cut(std::move(node), {});
    const bool narrows =
        next.stage == CutSearch::over_candidates || next.stage == CutSearch::gathering;
    if (narrows) keep_chosen(before, node);
    nodes_.push_back(std::move(node));
}

/// Keeps only the points in the slot that the node's owner has chosen. If the slot is beyond the
/// interval of the cut, its points are not open yet; the interval is then marked for widening.
void TreeSearch::keep_chosen(const CutSearch& before, Node& node) {
    const int slot = node.search.chosen;
    const bool is_first = slot == 0;
    const bool is_last = slot > layout_.num_bins;
    const Bins bins = bins_of(before, layout_);
    open_.choose(
        node.at, current_axis(before),
        {is_first ? -infinity : bins.edge(slot - 1), is_last ? infinity : bins.edge(slot)});
    node.is_wider =
        before.stage == CutSearch::over_points &&
        ((is_first && node.settled_below.count > 0) || (is_last && node.settled_above.count > 0));
}

}  // namespace rrcb
