#include "passes/histogram.hpp"

#include "arithmetic/quantum.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace rrcb {

namespace {

void widen(std::span<double> histogram, const Box& box) {
    for (std::size_t a = 0; a < max_dimension; ++a) {
        histogram[a] = std::max(histogram[a], -box.lower[a]);
        histogram[max_dimension + a] = std::max(histogram[max_dimension + a], box.upper[a]);
    }
}

template <std::size_t dimension>
void count(const Collected& collected, const Entries& entries, int axis, const Bins& bins,
           const HistogramLayout& layout, std::span<double> histogram) {
    const std::span<double> weights = sums_in(histogram).first(layout.num_slots());
    const std::span<double> counts = sums_in(histogram).last(layout.num_slots());
    Box box;
    for (const LocalIndex i : entries) {
        const double* const x = &collected.coordinates[i * dimension];
        for (std::size_t a = 0; a < dimension; ++a) {
            box.lower[a] = std::min(box.lower[a], x[a]);
            box.upper[a] = std::max(box.upper[a], x[a]);
        }
        const auto slot = static_cast<std::size_t>(bins.slot_of(x[axis]));
        if (layout.is_weighted) weights[slot] += collected.weight(i);
        counts[slot] += 1;
    }
    widen(histogram, box);
}

}  // namespace

void clear_histogram(std::span<double> histogram) {
    std::ranges::fill(histogram, 0.0);
    std::ranges::fill(histogram.first(HistogramLayout::num_extents),
                      -std::numeric_limits<double>::infinity());
}

void count(const Collected& collected, const Entries& entries, int axis, const Bins& bins,
           const HistogramLayout& layout, std::span<double> histogram) {
    if (collected.dimension == 1)
        return count<1>(collected, entries, axis, bins, layout, histogram);
    if (collected.dimension == 2)
        return count<2>(collected, entries, axis, bins, layout, histogram);
    count<3>(collected, entries, axis, bins, layout, histogram);
}

void count_sums(const Collected& collected, const Entries& entries, int axis, const Bins& bins,
                const HistogramLayout& layout, std::span<double> sums) {
    // A local copy lets the compiler assume that `sums` does not alias it.
    const Bins of_axis = bins;
    const std::span<double> weights = sums.first(layout.is_weighted ? layout.num_slots() : 0);
    const std::span<double> counts = sums.last(layout.num_slots());
    for (const LocalIndex i : entries) {
        const auto slot = static_cast<std::size_t>(of_axis.slot_of(collected.coordinate(i, axis)));
        if (layout.is_weighted) weights[slot] += collected.weight(i);
        counts[slot] += 1;
    }
}

void count_settled(const Total& total, const Box& box, int slot, const HistogramLayout& layout,
                   std::span<double> histogram) {
    if (!(total.count > 0)) return;
    widen(histogram, box);
    if (layout.is_weighted) sums_in(histogram)[static_cast<std::size_t>(slot)] += total.weight;
    histogram[layout.first_count() + static_cast<std::size_t>(slot)] += total.count;
}

void round_weights(double quantum, const HistogramLayout& layout, std::span<double> sums) {
    for (double& weight : sums.first(layout.is_weighted ? layout.num_slots() : 0))
        weight = rounded_to(quantum, weight);
}

void join_histograms(std::span<const double> other, std::span<double> histogram) {
    constexpr std::size_t num_extents = HistogramLayout::num_extents;
    for (std::size_t k = 0; k < num_extents; ++k) histogram[k] = std::max(histogram[k], other[k]);
    const auto sums = histogram.subspan(num_extents);
    std::ranges::transform(other.subspan(num_extents), sums, sums.begin(), std::plus<>());
}

Entries between(double lower, double upper, int axis, const Entries& entries,
                const Collected& collected) {
    Entries inside(entries.size());
    std::size_t num_inside = 0;
    // Has no branches, because they would be mispredicted for points in any order.
    for (const LocalIndex i : entries) {
        const double x = collected.coordinate(i, axis);
        inside[num_inside] = i;
        num_inside += (x >= lower ? 1 : 0) & (x < upper ? 1 : 0);
    }
    inside.resize(num_inside);
    return inside;
}

}  // namespace rrcb
