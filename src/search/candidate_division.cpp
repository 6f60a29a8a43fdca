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
    Division best{0, target.base, {}};
    double below = target.base;
    Ties ties{0, 0, below, 0};
    for (std::size_t k = 0; k < sorted.size(); ++k) {
        below += sorted[k].weight;
        if (k + 1 < sorted.size() && !before(sorted[k].position, sorted[k + 1].position)) continue;
        ties.count = k + 1 - ties.begin;
        ties.weight = below - ties.below;
        if (ties.count > 1 && ties.below < target.target && target.target < below) best.ties = ties;
        ties = {k + 1, 0, below, 0};
        if (target.excess(below) >= target.excess(best.below)) continue;
        best.num_below = k + 1;
        best.below = below;
    }
    return best;
}

}  // namespace rrcb
