#include "search/target_rule.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/part_share.hpp"
#include "bisection/bisection.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace rrcb {

double weight_of(const Descent& at, std::span<const double> part_weights) {
    return sum_of(part_weights.subspan(at.first_part, at.num_parts));
}

double TargetRule::size_of(const Descent& at) const {
    return part_sizes.empty() ? at.num_parts : sum_of(sizes_of(at));
}

double TargetRule::share_below(const Descent& at) const {
    if (part_sizes.empty()) return 1.0 * at.lower_parts() / at.num_parts;
    return rrcb::share_below(sizes_of(at), at.lower_parts());
}

/// Returns the ideal weight of the smallest part of a node.
double TargetRule::smallest_weight(const Descent& at) const {
    if (part_sizes.empty()) return weight_per_size;
    double smallest = infinity;
    for (const double size : sizes_of(at))
        if (size > 0) smallest = std::min(smallest, size * weight_per_size);
    return smallest;
}

/// Returns the tolerance that the smallest part of a node can make use of. If all points have the
/// same weight, a part contains whole points: if 16.16 points are allowed, it can have 16. If the
/// full tolerance were used, calls with few points in a part would miss it and need up to 12 more
/// rounds.
double TargetRule::attainable_tolerance(const Descent& at) const {
    if (common_weight == 0) return tolerance;
    const double smallest = smallest_weight(at);
    const double points = std::floor(tolerance * smallest / common_weight);
    return std::max(1.0, points * common_weight / smallest);
}

bool TargetRule::are_within(const Descent& at, std::span<const double> part_weights) const {
    // Computed in the same way as the imbalance that decides at the end, so that both are
    // bit-identical.
    const double sizes = sum_of(part_sizes);
    for (int k = 0; k < at.num_parts; ++k) {
        const int part = at.first_part + k;
        if (!(part_weights[part] > 0)) continue;
        if (!(part_weights[part] / counted_weight / (part_sizes[part] / sizes) <= tolerance))
            return false;
    }
    return true;
}

bool TargetRule::is_attainable() const {
    const Descent top = root_of(static_cast<int>(part_sizes.size()), {});
    return heaviest <= (tolerance - 1) * smallest_weight(top);
}

bool TargetRule::may_stay(const Descent& at, std::span<const double> part_weights) const {
    const auto may = [&](const Descent& side) {
        return are_within(side, part_weights) || weight_of(side, part_weights) <= most_weight(side);
    };
    return may(at.lower()) && may(at.upper());
}

/// Returns the largest weight with which a node's parts can still be within the tolerance although
/// each cut below is slightly off. The more levels there are below, the more of the tolerance is
/// reserved for them, up to half.
double TargetRule::most_weight(const Descent& at) const {
    const int all_levels = num_levels(at.shape, static_cast<int>(part_sizes.size()));
    const double left_below = num_levels(at.shape, at.num_parts) / (2.0 * all_levels);
    const double excess = (attainable_tolerance(at) - 1) * (1 - left_below);
    return weight_per_size * size_of(at) * (1 + excess);
}

CutTarget TargetRule::target_of(const Descent& at, double weight) const {
    CutTarget target;
    target.share = share_below(at);
    target.target = target.share * weight;
    // The point at the target has to go to one of the sides.
    const double of_both = 2 * target.share * (1 - target.share);
    target.slack = of_both * common_weight;
    // A target slightly below the exact one makes an odd point always go above the cut.
    if (is_exact) target.target = std::max(0.0, target.target - std::ldexp(common_weight, -12));
    if (is_exact || !(weight > 0)) return target;
    // The remaining tolerance of this node is divided into equal factors, one for each of its
    // levels.
    const double ideal = weight_per_size * size_of(at);
    const int levels = num_levels(at.shape, at.num_parts);
    const double growth = std::pow(attainable_tolerance(at) * ideal / weight, 1.0 / levels);
    target.slack = std::max(target.slack, of_both * (growth - 1) * weight);
    return target;
}

double TargetRule::missing_below(const Descent& at, std::span<const double> part_weights) const {
    return share_below(at) * weight_of(at, part_weights) - weight_of(at.lower(), part_weights);
}

CountLimits TargetRule::count_limits(const Descent& at, GlobalCount count, double weight) const {
    const auto sizes = part_sizes.empty() ? part_sizes : sizes_of(at);
    const bool are_equal =
        std::ranges::adjacent_find(sizes, std::ranges::not_equal_to{}) == sizes.end();
    if (!are_equal || count < at.num_parts) return {};
    constexpr double factor = 4;
    const GlobalCount least = at.lower_parts();
    return {least, count - at.num_parts + least, factor * weight};
}

}  // namespace rrcb
