#include "refinement/target_rule.hpp"

#include "bisection/bisection.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace rrcb {

namespace {

/// The tolerance with which the smallest of the parts still holds whole points, where all of them
/// weigh the same: where 16.16 points are allowed it can have no more than 16.
double attainable_tolerance(std::span<const double> sizes, const TargetRule& rule) {
    if (rule.common_weight == 0) return rule.tolerance;
    double smallest = std::numeric_limits<double>::infinity();
    for (const double size : sizes)
        if (size > 0) smallest = std::min(smallest, size * rule.weight_per_size);
    const double points = std::floor(rule.tolerance * smallest / rule.common_weight);
    return std::max(1.0, points * rule.common_weight / smallest);
}

}  // namespace

double TargetRule::share_below(const Descent& at) const {
    return rrcb::share_below(sizes_of(at));
}

CutTarget TargetRule::target_of(const Descent& at, double weight) const {
    const auto sizes = sizes_of(at);
    CutTarget target;
    target.target = share_below(at) * weight;
    target.slack = common_weight / 2;
    if (is_exact || !(weight > 0)) return target;
    // A part may end up too heavy by the tolerance in all. What is left of it at this node is
    // shared evenly with the levels below, as factors.
    const double ideal = weight_per_size * std::accumulate(sizes.begin(), sizes.end(), 0.0);
    const int levels = std::bit_width(static_cast<unsigned>(at.num_parts - 1));
    const double growth =
        std::pow(attainable_tolerance(sizes, *this) * ideal / weight, 1.0 / levels);
    target.slack =
        std::max(target.slack, (growth - 1) * std::min(target.target, weight - target.target));
    return target;
}

}  // namespace rrcb
