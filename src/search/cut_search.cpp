#include "search/cut_search.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/part_share.hpp"
#include "search/candidate_division.hpp"
#include "search/chosen_slot.hpp"
#include "search/gap.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace rrcb {

namespace {

std::size_t axis_index(const CutSearch& search, int tied) {
    return ordering_axis(search.cut.axis, tied);
}

void finish(CutSearch& search, double value, double below) {
    search.cut.at[axis_index(search, search.tied)] = value;
    search.stage = CutSearch::done;
    search.below = below;
}

/// Ends with the cut at a position, the first one above it.
void finish_at(CutSearch& search, const Vector& position, double below) {
    const PositionOrder order = order_of(search);
    for (const std::size_t axis : order.axes()) search.cut.at[axis] = position[axis];
    search.stage = CutSearch::done;
    search.below = below;
}

/// Ends with the cut behind a position, the last one below it.
void finish_behind(CutSearch& search, const Vector& position, double below) {
    finish_at(search, position, below);
    move_behind(search);
}

/// Ends among points that no cut separates: divides them, or leaves all of them on the side with
/// the smaller excess.
void finish_among_ties(CutSearch& search, const CutTarget& target, const Vector& position,
                       const Ties& ties) {
    const double above = ties.below + ties.weight;
    search.coincident = 1;
    if (target.divides) {
        search.lot_below = target.target - ties.below;
        finish_at(search, position, ties.below);
    } else if (target.excess(ties.below, ties.begin) <
               target.excess(above, ties.begin + ties.count)) {
        finish_at(search, position, ties.below);
    } else {
        finish_behind(search, position, above);
    }
}

/// Goes on along the next axis if all candidates have the coordinate `value` on this one; ends if
/// they share all of them.
void break_tie(CutSearch& search, const CutTarget& target, std::span<const double> extents,
               double value, double weight) {
    if (search.tied + 1 < search.num_axes) {
        search.cut.at[axis_index(search, search.tied++)] = value;
        const std::size_t axis = axis_index(search, search.tied);
        search.lower = -extents[axis];
        search.upper = std::nextafter(extents[max_dimension + axis], infinity);
        search.by_bits = 0;
        return;
    }
    Vector position{};
    position[axis_index(search, search.tied)] = value;
    finish_among_ties(search, target, position,
                      {target.base_count, target.num_candidates, target.base, weight});
}

struct CandidateRange {
    double smallest;
    double largest;
};

/// Goes on with the candidates in the chosen slot, of which the histogram has the weight and their
/// count.
void narrow(CutSearch& search, const CutTarget& target, const HistogramLayout& layout,
            std::span<const double> histogram, CandidateRange extent) {
    const Bins bins = bins_of(search, layout);
    const int slot = search.chosen;
    const double behind = std::nextafter(extent.largest, infinity);
    const double upper = slot > layout.num_bins ? behind : std::min(bins.edge(slot), behind);
    // By round-off the slot may be empty, and the extent above it.
    const double lower = std::min(
        upper, slot == 0 ? extent.smallest : std::max(bins.edge(slot - 1), extent.smallest));
    // The cut must not be among some of the candidates: another count finds their weight.
    const bool is_limited =
        search.tied == 0 && (lower < target.places.first || upper > target.places.last);
    const bool were_candidates =
        std::exchange(search.stage, CutSearch::over_candidates) == CutSearch::over_candidates;
    const bool is_few = target.num_candidates <= most_gathered;
    if (were_candidates && !is_limited && !is_few && std::nextafter(lower, infinity) >= upper)
        return break_tie(search, target, histogram, lower, weights_in(histogram, layout)[slot]);
    // The first two counts use bins of equal width. Candidates that are still undecided are
    // unevenly spread, so later bins hold equal numbers of doubles.
    search.by_bits = were_candidates ? 1 : 0;
    search.lower = is_limited ? std::max(lower, target.places.first) : lower;
    search.upper = is_limited ? std::min(upper, target.places.last) : upper;
    if (!is_limited && is_few) search.stage = CutSearch::gathering;
}

/// Returns true if all candidates share a coordinate at which the cut is allowed and may break
/// ties.
bool may_break_tie(const CutSearch& search, const CutTarget& target, const CandidateRange& extent,
                   const HistogramLayout& layout) {
    if (extent.smallest != extent.largest) return false;
    if (target.places.all() || search.tied > 0) return true;
    return !layout.limits[axis_index(search, 0)].has_grid() && search.lower <= extent.smallest &&
           extent.largest < search.upper;
}

/// Ends a limited search: at the first or the last allowed place if the target is beyond it.
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

/// Goes on in the chosen slot of a grid; ends at the nearer edge of a single cell.
void narrow_on_lines(CutSearch& search, const CutTarget& target, const HistogramLayout& layout,
                     const EdgeErrors& errors, double weight) {
    const Bins bins = bins_of(search, layout);
    const AxisLimits& limits = layout.limits[search.cut.axis];
    const int slot = search.chosen;
    const double lower = slot == 0 ? target.places.first : bins.edge(slot - 1);
    const double upper = slot > layout.num_bins ? target.places.last : bins.edge(slot);
    if (slot > 0 && slot <= layout.num_bins && limits.place_behind(lower) >= upper) {
        finish(search, errors.at_lower() ? lower : upper,
               target.base + (errors.at_lower() ? 0 : weight));
        return;
    }
    search.lower = lower;
    search.upper = upper;
    search.stage = CutSearch::over_candidates;
}

}  // namespace

void move_behind(CutSearch& search) {
    double& value = search.cut.at[axis_index(search, search.num_axes - 1)];
    value = std::nextafter(value, infinity);
}

PositionOrder order_of(const CutSearch& search) {
    return {search.cut.axis, search.tied, search.num_axes};
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
    const int axis = current_axis(search);
    if (!(target.target > 0)) {
        search.stage = CutSearch::done;
        if (!target.places.all()) finish(search, search.lower, weights[0]);
        return;
    }
    const CandidateRange extent{-histogram[axis], histogram[max_dimension + axis]};
    const Bins bins = bins_of(search, layout);
    if (search.stage == CutSearch::over_candidates &&
        may_break_tie(search, target, extent, layout)) {
        search.chosen = bins.slot_of(extent.smallest);
        return break_tie(search, target, histogram, extent.smallest, sum_of(weights));
    }
    const auto counts = counts_in(histogram, layout);
    const Chosen chosen = choose(target, weights, counts);
    if (finish_at_limit(search, target, weights, chosen)) return;
    const int slot = chosen.slot;
    const EdgeErrors errors = errors_at(chosen, weights[slot], counts[slot], target);
    const int edge = chosen.slot - (errors.at_lower() ? 1 : 0);
    if (edge >= 0 && edge <= layout.num_bins && errors.least() <= target.slack) {
        finish(search, bins.edge(edge), chosen.below + (errors.at_lower() ? 0 : weights[slot]));
        return;
    }
    search.chosen = slot;
    target.base = chosen.below;
    target.base_count = chosen.count;
    target.num_candidates = static_cast<GlobalCount>(counts[slot]);
    if (layout.limits[axis].has_grid()) {
        narrow_on_lines(search, target, layout, errors, weights[slot]);
    } else {
        narrow(search, target, layout, histogram, extent);
    }
}

bool decide_among(CutSearch& search, const CutTarget& target, std::span<const double> records,
                  int dimension) {
    std::vector<Candidate> candidates = read_candidates(records, dimension);
    // An order that does not depend on their routes to the owner.
    std::ranges::sort(candidates, {},
                      [](const Candidate& one) { return std::tie(one.position, one.weight); });
    const PositionOrder before = order_of(search);
    std::ranges::stable_sort(candidates, before, &Candidate::position);

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
    while (last_below[axis_index(search, search.tied)] ==
           first_above[axis_index(search, search.tied)]) {
        const std::size_t axis = axis_index(search, search.tied++);
        search.cut.at[axis] = first_above[axis];
    }
    const std::size_t axis = axis_index(search, search.tied);
    finish(search, middle_of(last_below[axis], first_above[axis]), division.below);
    return true;
}

}  // namespace rrcb
