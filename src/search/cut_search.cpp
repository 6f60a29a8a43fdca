#include "search/cut_search.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/middle.hpp"
#include "arithmetic/position_order.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace rrcb {

namespace {

std::size_t axis_index(const CutSearch& search, int tied) {
    return ordering_axis(search.cut.axis, tied);
}

/// Ends the search with a coordinate on the current axis.
void finish(CutSearch& search, double value, double below) {
    search.cut.at[axis_index(search, search.tied)] = value;
    search.stage = CutSearch::done;
    search.found_below = below;
}

/// Coincident points, and the points below them.
struct Ties {
    GlobalCount begin = 0;  ///< number of the points below
    GlobalCount count = 0;
    double below = 0;
    double weight = 0;
};

/// Ends the search at inseparable points. Divides them if that is allowed; otherwise leaves all of
/// them on the side with the smaller excess.
void finish_among_ties(CutSearch& search, const CutTarget& target, const Vector& position,
                       const Ties& ties) {
    const double above = ties.below + ties.weight;
    const bool is_below =
        target.excess(ties.below, ties.begin) >= target.excess(above, ties.begin + ties.count);
    search.coincident = 1;
    // A cut at a position is just below it: this position belongs to the upper side.
    for (int k = search.tied; k < search.num_axes; ++k) {
        const std::size_t axis = axis_index(search, k);
        search.cut.at[axis] = position[axis];
    }
    search.stage = CutSearch::done;
    search.found_below = ties.below;
    if (target.divides) {
        search.lot_below = target.target - ties.below;
    } else if (is_below) {
        search.found_below = above;
        move_behind(search);
    }
}

/// All candidates have the coordinate `value` on the current axis. Continues along the next axis,
/// or ends the search if there is none.
void break_tie(CutSearch& search, const CutTarget& target, std::span<const double> extents,
               double value, double weight) {
    search.cut.at[axis_index(search, search.tied)] = value;
    if (search.tied + 1 == search.num_axes)
        return finish_among_ties(
            search, target, Vector(search.cut.at),
            {target.count_before, target.num_candidates, target.weight_before, weight});
    const std::size_t axis = axis_index(search, ++search.tied);
    search.lower = -extents[axis];
    search.upper = std::nextafter(extents[max_dimension + axis], infinity);
    search.by_bits = 0;
}

/// Continues with the candidates in the chosen slot of the histogram.
void narrow(CutSearch& search, const CutTarget& target, const HistogramLayout& layout,
            std::span<const double> histogram) {
    const int axis = current_axis(search);
    const double smallest = -histogram[axis];
    const double behind = std::nextafter(histogram[max_dimension + axis], infinity);
    const Bins bins = bins_of(search, layout);
    const int slot = search.chosen;
    const double upper = slot > layout.num_bins ? behind : std::min(bins.edge(slot), behind);
    // Because of round-off the slot may be empty, and the points above it.
    const double lower =
        std::min(upper, slot == 0 ? smallest : std::max(bins.edge(slot - 1), smallest));
    // If a limit is inside the slot, the cut must not be among the candidates beyond it. The
    // bracket is therefore cut off at the limits, and counted once more.
    const bool is_limited =
        search.tied == 0 && (lower < target.places.first || upper > target.places.last);
    const bool were_candidates =
        std::exchange(search.stage, CutSearch::over_candidates) == CutSearch::over_candidates;
    const bool is_few = target.num_candidates <= most_gathered;
    if (were_candidates && !is_limited && !is_few && std::nextafter(lower, infinity) >= upper)
        return break_tie(search, target, histogram, lower, weights_in(histogram, layout)[slot]);
    // The first two counts use bins of equal width. If candidates are still undecided after them,
    // their spacing is uneven, so later bins contain equal numbers of doubles.
    search.by_bits = were_candidates ? 1 : 0;
    search.lower = is_limited ? std::max(lower, target.places.first) : lower;
    search.upper = is_limited ? std::min(upper, target.places.last) : upper;
    if (!is_limited && is_few) search.stage = CutSearch::gathering;
}

/// The slot of the histogram that contains the cut, and the points below it.
struct Chosen {
    int slot = 0;
    double below = 0;       ///< weight of these points
    GlobalCount count = 0;  ///< number of these points
};

/// Returns the slot for a target, given the weight and the number of points in each slot.
Chosen choose(const CutTarget& target, std::span<const double> weights,
              std::span<const double> counts) {
    Chosen chosen{0, target.weight_before, target.count_before};
    const int last = static_cast<int>(weights.size()) - 1;
    // The weight below the candidates and in all slots before this one is less than the target. So
    // the target is in this slot; because of round-off it may be beyond all slots, and then the
    // last one is taken. If there are few points, their number may also decide on the slot.
    while (chosen.slot < last) {
        const double next = chosen.below + weights[chosen.slot];
        const auto count = chosen.count + static_cast<GlobalCount>(counts[chosen.slot]);
        const bool is_enough = next >= target.target && count >= target.counts.least;
        if (is_enough || count >= target.counts.most) break;
        chosen = {chosen.slot + 1, next, count};
    }
    return chosen;
}

/// Ends a limited search at the first or last allowed position if the target is beyond it. Returns
/// false if it is not.
bool finish_at_limit(CutSearch& search, const CutTarget& target, std::span<const double> weights,
                     const Chosen& chosen) {
    if (target.places.all() || search.tied > 0) return false;
    const bool is_first = chosen.slot == 0 && search.lower <= target.places.first;
    const bool is_last =
        chosen.slot + 1 == std::ssize(weights) && search.upper >= target.places.last;
    if (is_first) finish(search, search.lower, chosen.below + weights[0]);
    if (is_last && !is_first) finish(search, search.upper, chosen.below);
    return is_first || is_last;
}

/// Continues in the chosen slot of grid cells. If that is a single cell, ends at its edge with the
/// smaller excess.
void narrow_on_lines(CutSearch& search, const CutTarget& target, const HistogramLayout& layout,
                     double weight, bool is_at_lower) {
    const Bins bins = bins_of(search, layout);
    const AxisLimits& limits = layout.limits[search.cut.axis];
    const int slot = search.chosen;
    const double lower = slot == 0 ? target.places.first : bins.edge(slot - 1);
    const double upper = slot > layout.num_bins ? target.places.last : bins.edge(slot);
    if (slot > 0 && slot <= layout.num_bins && limits.place_behind(lower) >= upper) {
        finish(search, is_at_lower ? lower : upper,
               target.weight_before + (is_at_lower ? 0 : weight));
        return;
    }
    search.lower = lower;
    search.upper = upper;
    search.stage = CutSearch::over_candidates;
}

/// A point that may still end on either side of a cut.
struct Candidate {
    Vector position{};
    double weight = 0;
};

/// Returns the candidates in an order that does not depend on the path of their messages.
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

/// Division of sorted candidates into those below and those above a cut.
struct Division {
    GlobalCount count = 0;  ///< points of the node below the cut
    double below = 0;       ///< weight of these points
    Ties ties{};  ///< coincident candidates among which the target is, if there are several
};

/// Returns the division of sorted candidates with the least excess.
Division best_division(std::span<const Candidate> sorted, const PositionOrder& before,
                       const CutTarget& target) {
    Division best{target.count_before, target.weight_before, {}};
    double below = target.weight_before;
    Ties ties{target.count_before, 0, below, 0};
    for (std::size_t k = 0; k < sorted.size(); ++k) {
        below += sorted[k].weight;
        if (k + 1 < sorted.size() && !before(sorted[k].position, sorted[k + 1].position)) continue;
        const GlobalCount count = target.count_before + static_cast<GlobalCount>(k + 1);
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

}  // namespace

void move_behind(CutSearch& search) {
    double& value = search.cut.at[axis_index(search, search.num_axes - 1)];
    value = std::nextafter(value, infinity);
}

int current_axis(const CutSearch& search) {
    return static_cast<int>(axis_index(search, search.tied));
}

Bins bins_of(const CutSearch& search, const HistogramLayout& layout) {
    const AxisLimits& limits = layout.limits[axis_index(search, search.tied)];
    if (limits.has_grid()) return {search.lower, search.upper, limits, layout.num_bins};
    return {search.lower, search.upper, search.by_bits != 0, layout.num_bins};
}

void decide_by_bins(CutSearch& search, CutTarget& target, const HistogramLayout& layout,
                    std::span<const double> histogram) {
    const auto weights = weights_in(histogram, layout);
    const auto counts = counts_in(histogram, layout);
    // If points below the bracket have been assigned already, they must become candidates first.
    const bool may_end_below = search.stage != CutSearch::over_points || !(counts[0] > 0);
    if (!(target.target > 0) && (may_end_below || !target.places.all()))
        return target.places.all() ? finish(search, -infinity, 0)
                                   : finish(search, search.lower, weights[0]);
    const Chosen chosen = choose(target, weights, counts);
    if (finish_at_limit(search, target, weights, chosen)) return;
    const int slot = chosen.slot;
    const auto count = static_cast<GlobalCount>(counts[slot]);
    const double at_lower = target.excess(chosen.below, chosen.count);
    const double at_upper = target.excess(chosen.below + weights[slot], chosen.count + count);
    const bool is_at_lower = at_lower <= at_upper;
    const int edge = is_at_lower ? slot - 1 : slot;
    if (edge >= 0 && edge <= layout.num_bins && std::min(at_lower, at_upper) <= target.slack)
        return finish(search, bins_of(search, layout).edge(edge),
                      chosen.below + (is_at_lower ? 0 : weights[slot]));
    search.chosen = slot;
    target.weight_before = chosen.below;
    target.count_before = chosen.count;
    target.num_candidates = count;
    if (layout.limits[axis_index(search, search.tied)].has_grid()) {
        narrow_on_lines(search, target, layout, weights[slot], is_at_lower);
    } else {
        narrow(search, target, layout, histogram);
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
    const auto best = static_cast<std::size_t>(division.count - target.count_before);
    search.coincident = division.ties.count > 0 ? 1 : 0;
    const Ties& ties = division.ties;
    const bool good = target.excess(division.below, division.count) <= target.slack;
    if (search.coincident != 0 && target.divides && !good) {
        finish_among_ties(search, target, candidates[ties.begin - target.count_before].position,
                          ties);
        return false;
    }
    if (best == 0 || best == candidates.size()) {
        finish(search, best == 0 ? search.lower : search.upper, division.below);
        return false;
    }
    const Vector& last_below = candidates[best - 1].position;
    const Vector& first_above = candidates[best].position;
    // Because the division is between these two positions, they differ along at least one of the
    // remaining axes.
    std::size_t axis = 0;
    while (axis = axis_index(search, search.tied), last_below[axis] == first_above[axis]) {
        search.cut.at[axis] = first_above[axis];
        ++search.tied;
    }
    finish(search, middle_of(last_below[axis], first_above[axis]), division.below);
    return true;
}

}  // namespace rrcb
