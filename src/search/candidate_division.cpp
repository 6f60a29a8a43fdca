#include "search/candidate_division.hpp"

#include <algorithm>

namespace rrcb {

std::vector<Candidate> read_candidates(std::span<const double> records, int dimension) {
    const int length = dimension + 1;
    std::vector<Candidate> candidates(records.size() / length);
    for (Candidate& candidate : candidates) {
        std::ranges::copy(records.first(dimension), candidate.position.begin());
        candidate.weight = records[dimension];
        records = records.subspan(length);
    }
    return candidates;
}

Division best_division(std::span<const Candidate> sorted, const PositionOrder& before,
                       const CutTarget& target) {
    Division best{target.base_count, target.base, {}};
    double below = target.base;
    Ties ties{target.base_count, 0, below, 0};
    for (std::size_t k = 0; k < sorted.size(); ++k) {
        below += sorted[k].weight;
        if (k + 1 < sorted.size() && !before(sorted[k].position, sorted[k + 1].position)) continue;
        const GlobalCount count = target.base_count + static_cast<GlobalCount>(k + 1);
        ties.count = count - ties.begin;
        ties.weight = below - ties.below;
        if (ties.count > 1 && ties.below < target.target && target.target < below) best.ties = ties;
        ties = {count, 0, below, 0};
        if (target.excess(below, count) >= target.excess(best.below, best.count)) continue;
        best.count = count;
        best.below = below;
    }
    return best;
}

}  // namespace rrcb
