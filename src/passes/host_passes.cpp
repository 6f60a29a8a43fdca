#include "passes/host_passes.hpp"

#include "options/validation.hpp"
#include "passes/summary.hpp"

#include <rrcb/detail/sample.hpp>

#include <algorithm>
#include <utility>

namespace rrcb {

HostPasses::HostPasses(const Points& points, std::vector<Part> memory)
    : points_(points), given_weights_(points.weights), parts_(std::move(memory)) {}

void HostPasses::use_weights(bool are_used) {
    points_.weights = are_used ? given_weights_ : std::span<const double>{};
}

PointSummary HostPasses::summary(bool reads_positions) {
    PointSummary summary = reads_positions ? summary_of(points_) : summary_of_weights(points_);
    parts_.resize(points_.count);
    return summary;
}

PointSample HostPasses::sample(LocalIndex size) {
    PointSample sample;
    const bool takes_all = size >= points_.count;
    const LocalIndex taken = takes_all ? points_.count : size;
    for (LocalIndex k = 0; k < taken; ++k) {
        const LocalIndex i = takes_all ? k : detail::sampled(k, points_.count);
        sample.positions.push_back(points_.position(i));
        if (!points_.weights.empty()) sample.weights.push_back(points_.weights[i]);
    }
    return sample;
}

PartTotals HostPasses::assign(const Cuts& cuts, bool counts) {
    EndTotals totals;
    if (counts)
        totals = assign_and_count(cuts, points_, parts_);
    else
        totals.all_finite = assign_ends(cuts, points_, parts_);
    if (!totals.all_finite) reject_coordinates(points_);
    return totals;
}

void HostPasses::settle(const Collected& collected, std::span<const Part> parts) {
    for (LocalIndex k = 0; k < collected.count(); ++k) parts_[collected.original[k]] = parts[k];
}

void HostPasses::renumber(std::span<const Part> numbers) {
    if (numbers.size() == 1)
        std::ranges::fill(parts_, numbers[0]);
    else
        for (Part& part : parts_) part = numbers[part];
}

void HostPasses::set_parts(std::span<const Part> parts) {
    std::ranges::copy(parts, parts_.begin());
}

}  // namespace rrcb
