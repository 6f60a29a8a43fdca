#include "search/local_search.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/quantum.hpp"
#include "arithmetic/running_sums.hpp"

#include <algorithm>
#include <array>

namespace rrcb {

namespace {

class Tally {
  public:
    Tally(const HistogramLayout& layout, int dimension, std::span<double> histogram)
        : extents_(histogram.first(HistogramLayout::num_extents)),
          weights_(histogram.subspan(HistogramLayout::num_extents, layout.num_slots())),
          counts_(histogram.last(layout.num_slots())),
          dimension_(static_cast<std::size_t>(dimension)) {}

    void widen(const Vector& lower, const Vector& upper) {
        for (std::size_t a = 0; a < dimension_; ++a) {
            extents_[a] = std::max(extents_[a], -lower[a]);
            extents_[max_dimension + a] = std::max(extents_[max_dimension + a], upper[a]);
        }
    }

    void add(std::int32_t slot, double weight, double count) {
        weights_[slot] += weight;
        counts_[slot] += count;
    }

    void round_weights_to(double quantum) {
        for (double& weight : weights_) weight = rounded_to(quantum, weight);
    }

  private:
    std::span<double> extents_;
    std::span<double> weights_;
    std::span<double> counts_;
    std::size_t dimension_;
};

/// Calls visit(i) for the entries of a fragment from `lower` to below `upper` across an axis;
/// returns the number of entries below `lower`. Without branches on the unordered coordinates.
template <class Visit>
LocalIndex visit_between(double lower, double upper, int axis, const Fragment& fragment,
                         const SortedPoints& points, Visit&& visit) {
    std::array<LocalIndex, 256> inside;
    const auto stride = static_cast<LocalIndex>(points.dimension());
    const double* const x = points.coordinates.data() + axis;
    LocalIndex num_below = 0;
    in_ranges(fragment.end - fragment.begin, inside.size(), [&](LocalIndex first, LocalIndex last) {
        std::size_t num_inside = 0;
        for (LocalIndex i = fragment.begin + first; i < fragment.begin + last; ++i) {
            const double value = x[i * stride];
            inside[num_inside] = i;
            num_inside += (value >= lower ? 1 : 0) & (value < upper ? 1 : 0);
            num_below += value < lower ? 1 : 0;
        }
        for (const LocalIndex i : std::span(inside).first(num_inside)) visit(i);
    });
    return num_below;
}

}  // namespace

void LocalSearch::count(const CutSearch& search, const HistogramLayout& layout,
                        std::span<double> histogram) const {
    Tally tally(layout, points_.dimension(), histogram);
    const int axis = current_axis(search);
    if (search.stage == CutSearch::over_fragments) {
        count_fragments(search, layout, histogram);
    } else {
        const Bins bins = bins_of(search, layout);
        for (const LocalIndex i : candidates_) {
            const Vector x = points_.position(i);
            tally.widen(x, x);
            tally.add(bins.slot_of(x[axis]), points_.weight(i), 1);
        }
    }
    tally.round_weights_to(search.quantum);
}

void LocalSearch::count_fragments(const CutSearch& search, const HistogramLayout& layout,
                                  std::span<double> histogram) const {
    Tally tally(layout, points_.dimension(), histogram);
    const int axis = current_axis(search);
    const int d = points_.dimension();
    const Bins bins = bins_of(search, layout);
    const int last_slot = layout.num_bins + 1;
    for (const Fragment& fragment : fragments_) {
        tally.widen(fragment.box.lower, fragment.box.upper);
        const std::int32_t first = bins.slot_of(fragment.box.lower[axis]);
        const std::int32_t last = bins.slot_of(fragment.box.upper[axis]);
        if (first == last) {
            tally.add(first, fragment.weight, static_cast<double>(fragment.end - fragment.begin));
            continue;
        }
        const auto add = [&](LocalIndex i) {
            tally.add(bins.slot_of(points_.coordinates[i * d + axis]), points_.weight(i), 1);
        };
        if (!points_.weights.empty()) {
            for (LocalIndex i = fragment.begin; i < fragment.end; ++i) add(i);
            continue;
        }
        LocalIndex num_inside = 0;
        const LocalIndex num_below =
            visit_between(search.lower, search.upper, axis, fragment, points_, [&](LocalIndex i) {
                add(i);
                ++num_inside;
            });
        const auto below = static_cast<double>(num_below);
        const auto count = static_cast<double>(fragment.end - fragment.begin - num_inside);
        tally.add(0, below, below);
        tally.add(last_slot, count - below, count - below);
    }
}

void LocalSearch::keep_chosen(const CutSearch& before, const CutSearch& after,
                              const HistogramLayout& layout) {
    if (after.stage == CutSearch::done) return;
    const Bins bins = bins_of(before, layout);
    const int last_slot = layout.num_bins + 1;
    const int axis = current_axis(before);
    const int d = points_.dimension();
    const auto is_chosen = [&](LocalIndex i) {
        return bins.slot_of(points_.coordinates[i * d + axis]) == after.chosen;
    };
    if (before.stage == CutSearch::over_candidates) {
        std::erase_if(candidates_, [&](LocalIndex i) { return !is_chosen(i); });
        return;
    }
    const double lower = after.chosen == 0 ? -infinity : bins.edge(after.chosen - 1);
    const double upper = after.chosen == last_slot ? infinity : bins.edge(after.chosen);
    for (const Fragment& fragment : fragments_) {
        if (bins.slot_of(fragment.box.lower[axis]) > after.chosen) continue;
        if (bins.slot_of(fragment.box.upper[axis]) < after.chosen) continue;
        visit_between(lower, upper, axis, fragment, points_,
                      [&](LocalIndex i) { candidates_.push_back(i); });
    }
}

void LocalSearch::append_candidates(std::vector<double>& records) const {
    for (const LocalIndex i : candidates_) {
        const Vector x = points_.position(i);
        records.insert(records.end(), x.begin(), x.begin() + points_.dimension());
        records.push_back(points_.weight(i));
    }
}

}  // namespace rrcb
