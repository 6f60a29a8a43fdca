#include "search/local_search.hpp"

#include "search/sample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rrcb {

namespace {

/// The entries of a histogram, to add to.
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

}  // namespace

void LocalSearch::count(const CutSearch& search, const HistogramLayout& layout,
                        std::span<double> histogram) const {
    Tally tally(layout, points_.dimension(), histogram);
    const int axis = current_axis(search);
    if (search.stage == CutSearch::over_fragments) {
        count_fragments(search, layout, histogram);
    } else if (search.stage == CutSearch::over_candidates) {
        const Bins bins = bins_of(search, layout);
        for (const LocalIndex i : candidates_) {
            const Vector x = points_.position(i);
            tally.widen(x, x);
            tally.add(bins.slot_of(x[axis]), points_.weight(i), 1);
        }
    } else {
        const PositionOrder order = order_of(search);
        for (const LocalIndex i : candidates_)
            tally.add(slot_between(splitters_, order, points_.position(i)), points_.weight(i), 1);
    }
    tally.round_weights_to(search.quantum);
}

void LocalSearch::count_fragments(const CutSearch& search, const HistogramLayout& layout,
                                  std::span<double> histogram) const {
    Tally tally(layout, points_.dimension(), histogram);
    const int axis = current_axis(search);
    const int d = points_.dimension();
    const Bins bins = bins_of(search, layout);
    for (const Fragment& fragment : fragments_) {
        tally.widen(fragment.box.lower, fragment.box.upper);
        const std::int32_t first = bins.slot_of(fragment.box.lower[axis]);
        const std::int32_t last = bins.slot_of(fragment.box.upper[axis]);
        if (first == last) {
            tally.add(first, fragment.weight, static_cast<double>(fragment.end - fragment.begin));
            continue;
        }
        for (LocalIndex i = fragment.begin; i < fragment.end; ++i)
            tally.add(bins.slot_of(points_.coordinates[i * d + axis]), points_.weight(i), 1);
    }
}

void LocalSearch::add_candidates(int rank, std::span<double> sample) const {
    for (const LocalIndex i : candidates_)
        add_to_sample(sample_key(rank, points_.original[i]), points_.position(i),
                      points_.dimension(), sample);
}

void LocalSearch::keep_chosen(const CutSearch& before, const CutSearch& after,
                              const HistogramLayout& layout) {
    if (after.stage == CutSearch::done || before.stage == CutSearch::sampling) return;
    if (before.stage == CutSearch::over_splitters) {
        const PositionOrder order = order_of(before);
        std::erase_if(candidates_, [&](LocalIndex i) {
            return slot_between(splitters_, order, points_.position(i)) != after.chosen;
        });
        return;
    }
    const Bins bins = bins_of(before, layout);
    const int axis = current_axis(before);
    const int d = points_.dimension();
    const auto is_chosen = [&](LocalIndex i) {
        return bins.slot_of(points_.coordinates[i * d + axis]) == after.chosen;
    };
    if (before.stage == CutSearch::over_candidates) {
        if (after.tied == before.tied)
            std::erase_if(candidates_, [&](LocalIndex i) { return !is_chosen(i); });
        return;
    }
    for (const Fragment& fragment : fragments_) {
        if (bins.slot_of(fragment.box.lower[axis]) > after.chosen) continue;
        if (bins.slot_of(fragment.box.upper[axis]) < after.chosen) continue;
        for (LocalIndex i = fragment.begin; i < fragment.end; ++i)
            if (is_chosen(i)) candidates_.push_back(i);
    }
}

void LocalSearch::append_candidates(std::vector<double>& records) const {
    for (const LocalIndex i : candidates_) {
        const Vector x = points_.position(i);
        records.insert(records.end(), x.begin(), x.begin() + points_.dimension());
        records.push_back(points_.weight(i));
    }
}

double quantum_for(double weight) {
    // Two digits more than a sum of `weight` needs, for nodes that weigh a little more.
    constexpr int digits = std::numeric_limits<double>::digits - 3;
    constexpr int smallest =
        std::numeric_limits<double>::min_exponent - std::numeric_limits<double>::digits;
    if (!(weight > 0)) return 0;
    return std::ldexp(1.0, std::max(std::ilogb(weight) - digits, smallest));
}

double rounded_to(double quantum, double value) {
    return quantum > 0 ? std::nearbyint(value / quantum) * quantum : value;
}

}  // namespace rrcb
