// What the owner of a node decides.
#include "refinement/region_search.hpp"
#include "refinement/sample.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <type_traits>
#include <utility>

namespace rrcb {

namespace {

/// Box that a histogram tells of.
Box box_in(std::span<const double> histogram) {
    Box box;
    for (std::size_t a = 0; a < max_dimension; ++a) {
        box.lower[a] = -histogram[a];
        box.upper[a] = histogram[max_dimension + a];
    }
    return box;
}

}  // namespace

void RegionSearch::decide(Butterfly& butterfly) {
    auto node = nodes_.begin();
    // Both ascend, and an owner takes part in all nodes that it owns.
    butterfly.owned().for_each([&](const Record& record) {
        node = std::ranges::find(node, nodes_.end(), record.key,
                                 [](const Node& one) { return key_of(one.at); });
        if (node != nodes_.end()) butterfly.answer(record.key, answer_to(record, *node));
    });
}

std::vector<double> RegionSearch::answer_to(const Record& record, Node& node) {
    static_assert(std::is_trivially_copyable_v<Answer> && sizeof(Answer) % sizeof(double) == 0);
    const bool is_searched = !node.divides_lot && !node.at.is_part();
    const CutSearch search = is_searched ? decide_on(node, record.payload) : node.search;
    Answer told{search, node.content.box, node.content.weight};
    if (!is_searched) place_weights(node, record.payload, told);
    std::vector<double> answer(Answer::length());
    std::memcpy(answer.data(), &told, sizeof told);
    if (search.stage == CutSearch::over_splitters && node.search.stage == CutSearch::sampling) {
        const auto sample = sample_in(record.payload.subspan(1));
        answer.insert(answer.end(), sample.begin(), sample.end());
    }
    return answer;
}

/// Weighs a part; or finds the rank that has points of a lot on both sides of its cut.
void RegionSearch::place_weights(const Node& node, std::span<const double> payload,
                                 Answer& answer) const {
    constexpr std::size_t length = 3;
    std::vector<std::pair<double, double>> weights;
    for (; !payload.empty(); payload = payload.subspan(length))
        weights.emplace_back(payload[1], payload[2]);
    std::ranges::sort(weights);
    if (node.at.is_part()) {
        answer.weight = 0;
        for (const auto& [rank, weight] : weights) answer.weight += weight;
        return;
    }
    answer.dividing_rank = tree_.num_ranks;
    for (const auto& [rank, weight] : weights) {
        if (answer.lot_before + weight > node.search.lot_below) {
            answer.dividing_rank = rank;
            return;
        }
        answer.lot_before += weight;
    }
}

/// Moves a search on by what all ranks have told, which is something once points are left to it.
CutSearch RegionSearch::decide_on(Node& node, std::span<const double> payload) {
    CutSearch search = node.search;
    if (payload.empty()) {
        // The weight was round-off.
        search.stage = CutSearch::done;
        node.content.weight = 0;
        return search;
    }
    const auto histogram = payload.subspan(1);
    if (search.stage == CutSearch::over_fragments) {
        decide_by_first_count(node, histogram, search);
    } else if (search.stage == CutSearch::over_candidates) {
        decide_by_bins(search, node.target, layout_, histogram);
    } else if (search.stage == CutSearch::sampling) {
        search.stage = CutSearch::over_splitters;
    } else if (search.stage == CutSearch::over_splitters) {
        decide_by_splitters(search, node.target, layout_, node.local.splitters(), histogram);
    } else {
        decide_among_candidates(node, payload, search);
    }
    if (search.stage == CutSearch::done) num_coincident_ += search.coincident;
    return search;
}

/// Decides among candidates in an order that does not depend on the ways that they came.
void RegionSearch::decide_among_candidates(const Node& node, std::span<const double> payload,
                                           CutSearch& search) const {
    const std::size_t length = static_cast<std::size_t>(dimension_) + 2;
    std::vector<std::span<const double>> marked;
    for (; !payload.empty(); payload = payload.subspan(length))
        marked.push_back(payload.first(length));
    std::ranges::sort(marked, [](const auto& a, const auto& b) {
        return std::ranges::lexicographical_compare(a, b);
    });
    std::vector<double> records;
    for (const auto& candidate : marked)
        records.insert(records.end(), candidate.begin() + 1, candidate.end());
    CutTarget target = node.target;
    decide_among(search, target, records, dimension_);
}

/// The first count tells where the points of the node lie, and what they weigh.
void RegionSearch::decide_by_first_count(Node& node, std::span<const double> histogram,
                                         CutSearch& search) {
    const auto weights = histogram.subspan(layout_.num_extents, layout_.num_slots());
    node.content.box = box_in(histogram);
    node.content.weight = std::accumulate(weights.begin(), weights.end(), 0.0);
    const CutSearch anew = first_search(node.at, node.content.box, node.content.weight);
    if (anew.cut.axis != search.cut.axis) {
        search = anew;
        return;
    }
    node.target = target_of(node.at, node.content.weight);
    decide_by_bins(search, node.target, layout_, histogram);
}

}  // namespace rrcb
