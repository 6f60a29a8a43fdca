// The decisions of the owner of a node.
#include "arithmetic/part_share.hpp"
#include "search/doubles.hpp"
#include "search/tree_search.hpp"

#include <algorithm>
#include <utility>

namespace rrcb {

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

/// Returns the records of ranks, by rank.
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
    // Both ascend, and an owner takes part in all nodes that it owns.
    butterfly.owned().for_each([&](const Record& record) {
        node = std::ranges::find(node, nodes_.end(), record.key,
                                 [](const Node& one) { return key_of(one.at); });
        if (node == nodes_.end()) return;
        CutSearch decided = node->at.is_part() ? node->search : decide_on(*node, record.payload);
        if (decided.stage == CutSearch::gathering) {
            // Candidates that are too many for one rank are counted once more.
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
    Answer told{decided, node.content.weight};
    if (node.at.is_part()) {
        told.weight = 0;
        for (const auto& [rank, points] : records_in<LotRecord>(record.payload))
            told.weight += points.weight;
    }
    append(told, answer);
    if (node.counts_parts) {
        const auto sums = guide_->sums.sums().subspan(node.at.first_part, node.at.num_parts);
        answer.insert(answer.end(), sums.begin(), sums.end());
    } else if (node.search.stage == CutSearch::dividing) {
        append(node.lot, answer);
    } else if (node.search.stage == CutSearch::over_points && !is_central()) {
        append(node.found, answer);
    }
    return answer;
}

/// Finds the first rank with points of a lot above the cut. If all points are on one side, the cut
/// leaves them there without dividing, because look-ups find the upper side of a cut that divides.
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
        search.below += lot.before;
        move_behind(search);
    }
    if (!is_above && !is_below) node.lot = {dividing->rank, lot.before};
    return search;
}

/// Advances a search with the joined records of all ranks. Empty records mean that it has no points
/// left.
CutSearch TreeSearch::decide_on(Node& node, std::span<const double> payload) {
    CutSearch search = node.search;
    if (search.stage == CutSearch::dividing) return decide_on_lot(node, payload);
    if (search.stage == CutSearch::centring) {
        search.stage = CutSearch::done;
        if (!payload.empty()) centre(search.cut, search.num_axes, payload.subspan(1));
        return search;
    }
    if (payload.empty()) {
        // The weight was round-off.
        search.stage = CutSearch::done;
        if (is_central())
            search.cut = cut_unsearched(node.at, node.content, tree_.rule.share_below(node.at));
        node.content.weight = 0;
        const std::vector<double> nothing(static_cast<std::size_t>(node.at.num_parts));
        if (node.counts_parts) take_sums(node, nothing);
        return search;
    }
    const auto records = payload.subspan(1);
    bool is_centred = false;
    if (search.stage == CutSearch::over_points) {
        decide_by_first_count(node, records, search);
    } else if (search.stage == CutSearch::over_candidates) {
        decide_by_bins(search, node.target, layout_of(search), records);
    } else {
        is_centred = decide_among(search, node.target, records, dimension_);
    }
    if (search.stage != CutSearch::done) return search;
    if (search.lot_below > 0) {
        search.stage = CutSearch::dividing;
    } else if (tree_.centres_cuts && !is_centred) {
        search.stage = CutSearch::centring;
    }
    return search;
}

/// Takes weight and box of the node from the first count.
void TreeSearch::decide_by_first_count(Node& node, std::span<const double> histogram,
                                       CutSearch& search) {
    const HistogramLayout layout = layout_of(search);
    const double weight = node.content.weight = sum_of(weights_in(histogram, layout));
    if (!is_central()) node.found = box_in(histogram);
    if (node.counts_parts && take_sums(node, histogram.subspan(layout.length()))) return;
    node.target = tree_.rule.target_of(node.at, weight, node.below);
    node.target.places = node.places;
    node.target.divides = tree_.divides_coincident && !tree_.plain_cuts;
    const auto count = static_cast<GlobalCount>(sum_of(counts_in(histogram, layout)));
    if (node.target.places.all())
        node.target.counts = tree_.rule.count_limits(node.at, count, weight);
    std::vector<double> along_axis;
    if (counts_all_axes(node)) histogram = along_axis = choose_axis(node, histogram, search);
    decide_by_bins(search, node.target, layout, histogram);
}

}  // namespace rrcb
