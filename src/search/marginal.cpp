#include "search/marginal.hpp"

#include "arithmetic/part_share.hpp"
#include "bisection/axis_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rrcb {

namespace {

/// Calls `visit` with half of both edges of each bin and its weight.
template <class Visit>
void for_each_bin(const Marginal& marginal, Visit&& visit) {
    // An edge behind the largest double is infinite.
    const auto half_edge = [&](int k) {
        return std::min(marginal.bins.edge(k), std::numeric_limits<double>::max()) / 2;
    };
    for (int slot = 1; slot + 1 < std::ssize(marginal.weights); ++slot)
        visit(half_edge(slot - 1), half_edge(slot), marginal.weights[slot]);
}

/// Returns half of the value with the weight `target` below it.
double half_quantile(const Marginal& marginal, double target) {
    double below = 0;
    double half = marginal.bins.edge(0) / 2;
    for_each_bin(marginal, [&](double lower, double upper, double weight) {
        if (below < target && weight > 0)
            half = std::lerp(lower, upper, std::min((target - below) / weight, 1.0));
        below += weight;
    });
    return half;
}

double weight_below(const Marginal& marginal, double half) {
    double below = 0;
    for_each_bin(marginal, [&](double lower, double upper, double weight) {
        if (half >= upper)
            below += weight;
        else if (half > lower)
            below += weight * ((half - lower) / (upper - lower));
    });
    return below;
}

}  // namespace

std::size_t fewest_near(std::span<const Marginal> marginals, const Box& box, std::size_t longest,
                        double target, double num_points) {
    const auto extent = [&](const Marginal& marginal) {
        return box.upper[marginal.axis] / 2 - box.lower[marginal.axis] / 2;
    };
    // A mean spacing, but at least a bin.
    const double spacings =
        std::clamp(std::pow(num_points, 1.0 / static_cast<double>(marginals.size())), 1.0,
                   static_cast<double>(std::ssize(marginals[longest].weights) - 2));
    const double half_reach = extent(marginals[longest]) / spacings;
    const auto near = [&](const Marginal& marginal) {
        const double half = half_quantile(marginal, target);
        return weight_below(marginal, half + half_reach) -
               weight_below(marginal, half - half_reach);
    };
    std::size_t best = longest;
    double fewest = near(marginals[longest]);
    // Few points show the weight near a cut with a large error.
    const double num_near = num_points * (fewest / sum_of(marginals[longest].weights));
    const double enough = nearly - 1 / std::sqrt(std::max(num_near, 1.0));
    for (std::size_t k = 0; k < marginals.size(); ++k) {
        if (!(extent(marginals[k]) > 0)) continue;
        const double fewer = near(marginals[k]);
        if (!(fewer < enough * fewest)) continue;
        best = k;
        fewest = fewer;
    }
    return best;
}

}  // namespace rrcb
