#include "cut_search.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// As many positions as are worth gathering instead of counting once more.
constexpr double most_gathered = 1024;

std::size_t axis_index(const CutSearch& search, int tied) {
    if (tied == 0) return static_cast<std::size_t>(search.cut.axis);
    return static_cast<std::size_t>(tied <= search.cut.axis ? tied - 1 : tied);
}

/// A bracket that takes in the largest double ends at infinity; its bins are as wide all the same.
double bin_width(const CutSearch& search, int num_bins) {
    const double upper = std::min(search.upper, std::numeric_limits<double>::max());
    return upper / num_bins - search.lower / num_bins;
}

void finish(CutSearch& search, double value, double below) {
    search.cut.at[axis_index(search, search.tied)] = value;
    search.stage = CutSearch::done;
    search.below = below;
}

/// Goes on along the next axis where all candidates share their coordinate on this one; ends where
/// they share all of them, with the lot on the side that is nearer to the target.
void break_tie(CutSearch& search, CutTarget& target, std::span<const double> extents,
               std::span<const double> weights) {
    const double value = extents[max_dimension + axis_index(search, search.tied)];
    if (search.tied + 1 < search.num_axes) {
        search.cut.at[axis_index(search, search.tied++)] = value;
        const std::size_t axis = axis_index(search, search.tied);
        search.lower = -extents[axis];
        search.upper = std::nextafter(extents[max_dimension + axis], infinity);
        return;
    }
    double weight = 0;
    for (const double w : weights) weight += w;
    search.coincident = 1;
    const bool above = target.target - target.base < weight / 2;
    finish(search, above ? value : std::nextafter(value, infinity),
           target.base + (above ? 0 : weight));
}

struct Extent {
    double smallest;
    double largest;
};

/// Goes on in one slot; where it is no narrower than what it was part of, no count can divide it.
void narrow(CutSearch& search, int num_bins, int slot, Extent extent, double count) {
    const double lower = slot == 0 ? extent.smallest : bin_edge(search, num_bins, slot - 1);
    const double upper = slot > num_bins ? std::nextafter(extent.largest, infinity)
                                         : bin_edge(search, num_bins, slot);
    const bool stuck = lower == search.lower && upper == search.upper;
    search.stage =
        stuck || count <= most_gathered ? CutSearch::gathering : CutSearch::over_candidates;
    search.lower = lower;
    search.upper = upper;
    search.chosen = slot;
}

struct Candidate {
    Vector position{};
    double weight = 0;
};

std::vector<Candidate> read_candidates(std::span<const double> records, int dimension) {
    const auto d = static_cast<std::size_t>(dimension);
    std::vector<Candidate> candidates(records.size() / (d + 1));
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        std::copy_n(records.begin() + static_cast<std::ptrdiff_t>(k * (d + 1)), d,
                    candidates[k].position.begin());
        candidates[k].weight = records[k * (d + 1) + d];
    }
    return candidates;
}

/// How many of the candidates are to lie below the cut.
struct Division {
    std::size_t num_below = 0;
    double below = 0;         ///< weight of the node below the cut
    bool coincident = false;  ///< the target lies among candidates that no cut tells apart
};

/// The division of sorted candidates that comes nearest to the target.
template <class Before>
Division best_division(std::span<const Candidate> sorted, const Before& before,
                       const CutTarget& target) {
    Division best{0, target.base, false};
    double below = target.base;
    double below_group = below;
    std::size_t group = 0;
    for (std::size_t k = 0; k < sorted.size(); ++k) {
        below += sorted[k].weight;
        if (k + 1 < sorted.size() && !before(sorted[k], sorted[k + 1])) continue;
        if (k > group && below_group < target.target && target.target < below)
            best.coincident = true;
        below_group = below;
        group = k + 1;
        if (std::abs(below - target.target) >= std::abs(best.below - target.target)) continue;
        best.num_below = group;
        best.below = below;
    }
    return best;
}

/// A slot of the histogram that the target falls into, with the weight below it.
struct Chosen {
    int slot = 0;
    double below = 0;
};

Chosen choose(double base, double target, std::span<const double> weights) {
    Chosen chosen{0, base};
    const int last = static_cast<int>(weights.size()) - 1;
    while (chosen.slot < last) {
        const double next = chosen.below + weights[static_cast<std::size_t>(chosen.slot)];
        if (next >= target) break;
        chosen.below = next;
        ++chosen.slot;
    }
    return chosen;
}

}  // namespace

int current_axis(const CutSearch& search) {
    return static_cast<int>(axis_index(search, search.tied));
}

double bin_edge(const CutSearch& search, int num_bins, int k) {
    const double step = bin_width(search, num_bins);
    return k == num_bins ? search.upper : std::min(search.lower + k * step, search.upper);
}

std::int32_t slot_of(const CutSearch& search, int num_bins, double value) {
    if (value < search.lower) return 0;
    if (!(value < search.upper)) return num_bins + 1;
    const double step = bin_width(search, num_bins);
    const double share = step > 0 ? (value - search.lower) / step : 0;
    int bin = static_cast<int>(std::clamp(share, 0.0, num_bins - 1.0));
    while (bin > 0 && value < bin_edge(search, num_bins, bin)) --bin;
    while (bin + 1 < num_bins && value >= bin_edge(search, num_bins, bin + 1)) ++bin;
    return bin + 1;
}

void LocalSearch::count(const CutSearch& search, const HistogramLayout& layout,
                        std::span<double> histogram) const {
    const auto axis = static_cast<std::size_t>(current_axis(search));
    const auto widen = [&](const Vector& lower, const Vector& upper) {
        for (std::size_t a = 0; a < static_cast<std::size_t>(points_.dimension()); ++a) {
            histogram[a] = std::max(histogram[a], -lower[a]);
            histogram[max_dimension + a] = std::max(histogram[max_dimension + a], upper[a]);
        }
    };
    const auto add = [&](std::int32_t slot, double weight, double number) {
        const std::size_t entry = layout.num_extents + static_cast<std::size_t>(slot);
        histogram[entry] += weight;
        histogram[entry + layout.num_slots()] += number;
    };
    const auto add_point = [&](LocalIndex i) {
        const double value =
            points_.coordinates[i * static_cast<std::size_t>(points_.dimension()) + axis];
        add(slot_of(search, layout.num_bins, value), points_.weight(i), 1);
    };
    if (search.stage == CutSearch::over_candidates) {
        for (const LocalIndex i : candidates_) {
            widen(points_.position(i), points_.position(i));
            add_point(i);
        }
        return;
    }
    for (const Fragment& fragment : fragments_) {
        widen(fragment.box.lower, fragment.box.upper);
        const std::int32_t first = slot_of(search, layout.num_bins, fragment.box.lower[axis]);
        const std::int32_t last = slot_of(search, layout.num_bins, fragment.box.upper[axis]);
        if (first == last) {
            add(first, fragment.weight, static_cast<double>(fragment.last - fragment.first));
        } else {
            for (LocalIndex i = fragment.first; i < fragment.last; ++i) add_point(i);
        }
    }
}

void LocalSearch::keep_chosen(const CutSearch& before, const CutSearch& after, int num_bins) {
    if (after.stage == CutSearch::done) return;
    const auto axis = static_cast<std::size_t>(current_axis(before));
    const auto d = static_cast<std::size_t>(points_.dimension());
    const auto is_chosen = [&](LocalIndex i) {
        return slot_of(before, num_bins, points_.coordinates[i * d + axis]) == after.chosen;
    };
    if (before.stage == CutSearch::over_candidates) {
        if (after.tied == before.tied)
            std::erase_if(candidates_, [&](LocalIndex i) { return !is_chosen(i); });
        return;
    }
    for (const Fragment& fragment : fragments_) {
        if (slot_of(before, num_bins, fragment.box.lower[axis]) > after.chosen) continue;
        if (slot_of(before, num_bins, fragment.box.upper[axis]) < after.chosen) continue;
        for (LocalIndex i = fragment.first; i < fragment.last; ++i)
            if (is_chosen(i)) candidates_.push_back(i);
    }
}

void LocalSearch::append_candidates(double list, std::vector<double>& records) const {
    for (const LocalIndex i : candidates_) {
        const Vector x = points_.position(i);
        records.push_back(list);
        records.insert(records.end(), x.begin(), x.begin() + points_.dimension());
        records.push_back(points_.weight(i));
    }
}

void decide(CutSearch& search, CutTarget& target, const HistogramLayout& layout,
            std::span<const double> histogram) {
    const auto weights = histogram.subspan(layout.num_extents, layout.num_slots());
    const auto axis = static_cast<std::size_t>(current_axis(search));
    if (!(target.target > 0)) {
        search.stage = CutSearch::done;
        return;
    }
    if (search.stage == CutSearch::over_candidates &&
        -histogram[axis] == histogram[max_dimension + axis]) {
        break_tie(search, target, histogram, weights);
        return;
    }
    const Chosen chosen = choose(target.base, target.target, weights);
    const double weight = weights[static_cast<std::size_t>(chosen.slot)];
    const double too_little = target.target - chosen.below;
    const double too_much = chosen.below + weight - target.target;
    const bool at_lower_edge = too_little <= too_much;
    const int edge = chosen.slot - (at_lower_edge ? 1 : 0);
    if (edge >= 0 && edge <= layout.num_bins && std::min(too_little, too_much) <= target.slack) {
        finish(search, bin_edge(search, layout.num_bins, edge),
               chosen.below + (at_lower_edge ? 0 : weight));
        return;
    }
    const double count =
        histogram[layout.num_extents + layout.num_slots() + static_cast<std::size_t>(chosen.slot)];
    target.base = chosen.below;
    target.num_candidates = static_cast<GlobalCount>(count);
    narrow(search, layout.num_bins, chosen.slot,
           {-histogram[axis], histogram[max_dimension + axis]}, count);
}

void decide_among(CutSearch& search, CutTarget& target, std::span<const double> records,
                  int dimension) {
    std::vector<Candidate> candidates = read_candidates(records, dimension);
    std::vector<std::size_t> axes;
    for (int tied = search.tied; tied < search.num_axes; ++tied)
        axes.push_back(axis_index(search, tied));
    const auto before = [&](const Candidate& a, const Candidate& b) {
        for (const std::size_t axis : axes)
            if (a.position[axis] != b.position[axis]) return a.position[axis] < b.position[axis];
        return false;
    };
    std::stable_sort(candidates.begin(), candidates.end(), before);

    const Division division = best_division(candidates, before, target);
    const std::size_t best = division.num_below;
    search.coincident = division.coincident ? 1 : 0;
    if (best == 0 || best == candidates.size()) {
        finish(search, best == 0 ? search.lower : search.upper, division.below);
        return;
    }
    const Vector& last_below = candidates[best - 1].position;
    const Vector& first_above = candidates[best].position;
    while (last_below[axis_index(search, search.tied)] ==
           first_above[axis_index(search, search.tied)]) {
        const std::size_t axis = axis_index(search, search.tied++);
        search.cut.at[axis] = first_above[axis];
    }
    const std::size_t axis = axis_index(search, search.tied);
    const double middle = last_below[axis] / 2 + first_above[axis] / 2;
    finish(search, middle > last_below[axis] ? middle : first_above[axis], division.below);
}

}  // namespace rrcb
