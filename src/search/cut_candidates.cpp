// How the search for one cut ends among positions.
#include "arithmetic/infinity.hpp"
#include "arithmetic/position_order.hpp"
#include "search/cut_search.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace rrcb {

namespace {

/// A point that may still end on either side of a cut.
struct Candidate {
    Vector position{};
    double weight = 0;
};

/// Returns candidates in an order that does not depend on their routes to the owner.
std::vector<Candidate> sorted_candidates(std::span<const double> records, int dimension,
                                         const PositionOrder& before) {
    const int length = dimension + 1;
    std::vector<Candidate> candidates(records.size() / length);
    for (Candidate& candidate : candidates) {
        std::ranges::copy(records.first(dimension), candidate.position.begin());
        candidate.weight = records[dimension];
        records = records.subspan(length);
    }
    std::ranges::sort(candidates, {},
                      [](const Candidate& one) { return std::tie(one.position, one.weight); });
    std::ranges::stable_sort(candidates, before, &Candidate::position);
    return candidates;
}

/// Candidates in two groups: those below the cut come first.
struct Division {
    GlobalCount count = 0;  ///< points of the node below the cut
    double below = 0;       ///< their weight
    Ties ties{};            ///< candidates that hold the target, if there are several
};

/// Returns the division with the least excess of sorted candidates, all above the base of the
/// target.
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

/// Returns the middle of two coordinates, or `above` if no double is between them.
double middle_of(double below, double above) {
    const double middle = below / 2 + above / 2;
    return middle > below ? middle : above;
}

}  // namespace

void move_behind(CutSearch& search) {
    double& value = search.cut.at[ordering_axis(search.cut.axis, search.num_axes - 1)];
    value = std::nextafter(value, infinity);
}

void finish(CutSearch& search, double value, double below) {
    search.cut.at[current_axis(search)] = value;
    search.stage = CutSearch::done;
    search.below = below;
}

void finish_among_ties(CutSearch& search, const CutTarget& target, const Vector& position,
                       const Ties& ties) {
    const double above = ties.below + ties.weight;
    const bool is_below =
        target.excess(ties.below, ties.begin) >= target.excess(above, ties.begin + ties.count);
    search.coincident = 1;
    // At a position the cut is the first one above it.
    for (int k = search.tied; k < search.num_axes; ++k) {
        const std::size_t axis = ordering_axis(search.cut.axis, k);
        search.cut.at[axis] = position[axis];
    }
    search.stage = CutSearch::done;
    search.below = ties.below;
    if (target.divides) {
        search.lot_below = target.target - ties.below;
    } else if (is_below) {
        search.below = above;
        move_behind(search);
    }
}

void centre(Cut& cut, int num_axes, std::span<const double> gap) {
    for (int k = 0; k < num_axes; ++k) {
        const double above = -gap[std::size_t{2} * k];
        const double below = gap[std::size_t{2} * k + 1];
        if (below == above) continue;
        const bool is_empty = below == -infinity && above == infinity;
        if (is_empty) return;
        cut.at[ordering_axis(cut.axis, k)] =
            above == infinity ? std::nextafter(below, infinity) : middle_of(below, above);
        while (++k < num_axes) cut.at[ordering_axis(cut.axis, k)] = -infinity;
    }
}

bool decide_among(CutSearch& search, const CutTarget& target, std::span<const double> records,
                  int dimension) {
    const PositionOrder before{search.cut.axis, search.tied, search.num_axes};
    const std::vector<Candidate> candidates = sorted_candidates(records, dimension, before);
    const Division division = best_division(candidates, before, target);
    const auto best = static_cast<std::size_t>(division.count - target.base_count);
    search.coincident = division.ties.count > 0 ? 1 : 0;
    const Ties& ties = division.ties;
    const bool good = target.excess(division.below, division.count) <= target.slack;
    if (search.coincident != 0 && target.divides && !good) {
        finish_among_ties(search, target, candidates[ties.begin - target.base_count].position,
                          ties);
        return false;
    }
    if (best == 0 || best == candidates.size()) {
        finish(search, best == 0 ? search.lower : search.upper, division.below);
        return false;
    }
    const Vector& last_below = candidates[best - 1].position;
    const Vector& first_above = candidates[best].position;
    // The two positions differ along an open axis, because the division is between them.
    std::size_t axis = 0;
    while (axis = ordering_axis(search.cut.axis, search.tied),
           last_below[axis] == first_above[axis]) {
        search.cut.at[axis] = first_above[axis];
        ++search.tied;
    }
    finish(search, middle_of(last_below[axis], first_above[axis]), division.below);
    return true;
}

}  // namespace rrcb
