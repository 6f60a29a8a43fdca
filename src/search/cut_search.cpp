#include "search/cut_search.hpp"

#include "arithmetic/infinity.hpp"
#include "search/candidate_division.hpp"
#include "search/gap.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace rrcb {

namespace {

/// Counts of candidates in bins before splitters are used.
constexpr int most_counts = 4;

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
void finish_behind(CutSearch& search, Vector position, double below) {
    const std::size_t last = order_of(search).axes().back();
    position[last] = std::nextafter(position[last], infinity);
    finish_at(search, position, below);
}

/// Ends among points that no cut separates: divides them, or leaves all of them on the side with
/// the smaller excess.
void finish_among_ties(CutSearch& search, const CutTarget& target, const Vector& position,
                       double below_ties, double weight) {
    const double missing = target.target - below_ties;
    search.coincident = 1;
    if (search.divides != 0) {
        search.lot_below = missing;
        finish_at(search, position, target.target);
    } else if (target.excess(below_ties) < target.excess(below_ties + weight)) {
        finish_at(search, position, below_ties);
    } else {
        finish_behind(search, position, below_ties + weight);
    }
}

/// Goes on along the next axis if all candidates share their coordinate on this one; ends if they
/// share all of them.
void break_tie(CutSearch& search, CutTarget& target, std::span<const double> extents,
               std::span<const double> weights) {
    const double value = extents[max_dimension + axis_index(search, search.tied)];
    if (search.tied + 1 < search.num_axes) {
        search.cut.at[axis_index(search, search.tied++)] = value;
        const std::size_t axis = axis_index(search, search.tied);
        search.lower = -extents[axis];
        search.upper = std::nextafter(extents[max_dimension + axis], infinity);
        search.by_bits = 0;
        if (target.num_counts >= most_counts) search.stage = CutSearch::sampling;
        return;
    }
    double weight = 0;
    for (const double w : weights) weight += w;
    Vector position{};
    const PositionOrder order = order_of(search);
    for (const std::size_t axis : order.axes()) position[axis] = extents[max_dimension + axis];
    finish_among_ties(search, target, position, target.base, weight);
}

struct CandidateRange {
    double smallest;
    double largest;
};

/// Goes on with the candidates in the chosen slot: by another count in bins, or by splitters after
/// most_counts of them.
void narrow(CutSearch& search, CutTarget& target, const Bins& bins, int num_bins,
            CandidateRange extent) {
    const int slot = search.chosen;
    const double lower = slot == 0 ? extent.smallest : bins.edge(slot - 1);
    const double upper =
        slot > num_bins ? std::nextafter(extent.largest, infinity) : bins.edge(slot);
    // The cut must not be among some of the candidates: another count finds their weight.
    const bool is_limited =
        search.tied == 0 && (lower < target.places.first || upper > target.places.last);
    // The first two counts use bins of equal width. Candidates that are still undecided are
    // unevenly spread, so later bins hold equal numbers of doubles.
    search.by_bits = search.stage == CutSearch::over_candidates ? 1 : 0;
    search.lower = is_limited ? std::max(lower, target.places.first) : lower;
    search.upper = is_limited ? std::min(upper, target.places.last) : upper;
    if (is_limited) {
        search.stage = CutSearch::over_candidates;
    } else if (target.num_candidates <= most_gathered) {
        search.stage = CutSearch::gathering;
    } else if (target.num_counts >= most_counts) {
        search.stage = CutSearch::sampling;
    } else {
        search.stage = CutSearch::over_candidates;
    }
}

/// Slot of the histogram that the target falls into, with the weight below it.
struct Chosen {
    int slot = 0;
    double below = 0;
};

Chosen choose(double base, double target, std::span<const double> weights) {
    Chosen chosen{0, base};
    const int last = static_cast<int>(weights.size()) - 1;
    // The base and all slots before this one weigh less than the target. So the target is in this
    // slot, or by round-off behind all slots, and the last one is taken.
    while (chosen.slot < last) {
        const double next = chosen.below + weights[chosen.slot];
        if (next >= target) break;
        chosen.below = next;
        ++chosen.slot;
    }
    return chosen;
}

/// Excess of a cut at either edge of a slot.
struct EdgeErrors {
    double lower;
    double upper;

    bool at_lower() const { return lower <= upper; }
    double least() const { return std::min(lower, upper); }
};

EdgeErrors errors_at(const Chosen& chosen, double weight, const CutTarget& target) {
    return {target.excess(chosen.below), target.excess(chosen.below + weight)};
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

/// Notes the chosen slot and its weight and count.
void go_on_in(const Chosen& chosen, double count, CutSearch& search, CutTarget& target) {
    search.chosen = chosen.slot;
    target.base = chosen.below;
    target.num_candidates = static_cast<GlobalCount>(count);
}

}  // namespace

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

std::int32_t slot_between(std::span<const Vector> splitters, const PositionOrder& order,
                          const Vector& position) {
    const auto at = std::ranges::lower_bound(splitters, position, order);
    const auto slot = static_cast<std::int32_t>(2 * (at - splitters.begin()));
    return at != splitters.end() && !order(position, *at) ? slot + 1 : slot;
}

std::vector<Vector> splitters_of(std::vector<Vector> sample, const PositionOrder& order,
                                 const HistogramLayout& layout) {
    const auto same = [&](const Vector& a, const Vector& b) {
        return !order(a, b) && !order(b, a);
    };
    std::ranges::sort(sample, order);
    sample.erase(std::unique(sample.begin(), sample.end(), same), sample.end());
    const std::size_t most = (layout.num_slots() - 1) / 2;
    const std::size_t count = std::min(most, sample.size());
    // Evenly spread over the sample, if `count` is less than its length.
    for (std::size_t k = 0; k < count; ++k)
        sample[k] = sample[(2 * k + 1) * sample.size() / (2 * count)];
    sample.resize(count);
    return sample;
}

void decide_by_bins(CutSearch& search, CutTarget& target, const HistogramLayout& layout,
                    std::span<const double> histogram) {
    const auto weights = histogram.subspan(layout.num_extents, layout.num_slots());
    const auto counts = histogram.subspan(layout.num_extents + layout.num_slots());
    const int axis = current_axis(search);
    if (!(target.target > 0)) {
        search.stage = CutSearch::done;
        if (!target.places.all()) finish(search, search.lower, weights[0]);
        return;
    }
    const bool counted_candidates = search.stage == CutSearch::over_candidates;
    target.num_counts += counted_candidates ? 1 : 0;
    const CandidateRange extent{-histogram[axis], histogram[max_dimension + axis]};
    if (counted_candidates && may_break_tie(search, target, extent, layout)) {
        break_tie(search, target, histogram, weights);
        return;
    }
    const Bins bins = bins_of(search, layout);
    const Chosen chosen = choose(target.base, target.target, weights);
    if (finish_at_limit(search, target, weights, chosen)) return;
    const int slot = chosen.slot;
    const EdgeErrors errors = errors_at(chosen, weights[slot], target);
    const int edge = chosen.slot - (errors.at_lower() ? 1 : 0);
    if (edge >= 0 && edge <= layout.num_bins && errors.least() <= target.slack) {
        finish(search, bins.edge(edge), chosen.below + (errors.at_lower() ? 0 : weights[slot]));
        return;
    }
    go_on_in(chosen, counts[slot], search, target);
    if (layout.limits[axis].has_grid()) {
        narrow_on_lines(search, target, layout, errors, weights[slot]);
    } else {
        narrow(search, target, bins, layout.num_bins, extent);
    }
}

void decide_by_splitters(CutSearch& search, CutTarget& target, const HistogramLayout& layout,
                         std::span<const Vector> splitters, std::span<const double> histogram) {
    const auto weights =
        histogram.subspan(layout.num_extents, layout.num_slots()).first(2 * splitters.size() + 1);
    const auto counts = histogram.subspan(layout.num_extents + layout.num_slots());
    const Chosen chosen = choose(target.base, target.target, weights);
    const int slot = chosen.slot;
    const EdgeErrors errors = errors_at(chosen, weights[slot], target);
    const bool at_splitter = slot % 2 == 1;
    // Between two slots is the near or the far side of a splitter. The outermost edges were
    // considered before.
    const std::size_t edge = errors.at_lower() ? slot : slot + 1;
    if (errors.least() <= target.slack && edge > 0 && edge < weights.size()) {
        const double below = chosen.below + (errors.at_lower() ? 0 : weights[slot]);
        const Vector& splitter = splitters[(edge - 1) / 2];
        if (edge % 2 == 1) finish_at(search, splitter, below);
        if (edge % 2 == 0) finish_behind(search, splitter, below);
        return;
    }
    if (at_splitter) {
        finish_among_ties(search, target, splitters[slot / 2], chosen.below, weights[slot]);
        return;
    }
    go_on_in(chosen, counts[slot], search, target);
    search.between_splitters = 1;
    search.stage =
        target.num_candidates <= most_gathered ? CutSearch::gathering : CutSearch::sampling;
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
    const std::size_t best = division.num_below;
    search.coincident = division.ties.count > 0 ? 1 : 0;
    const bool good = target.excess(division.below) <= target.slack;
    if (search.coincident != 0 && search.divides != 0 && !good) {
        const Ties& ties = division.ties;
        finish_among_ties(search, target, candidates[ties.begin].position, ties.below, ties.weight);
        return false;
    }
    if (best == 0 || best == candidates.size()) {
        if (search.between_splitters == 0) {
            finish(search, best == 0 ? search.lower : search.upper, division.below);
        } else if (best == 0) {
            finish_at(search, candidates.front().position, division.below);
        } else {
            finish_behind(search, candidates.back().position, division.below);
        }
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
