#include "arithmetic/part_share.hpp"
#include "options/rejection.hpp"

#include <rrcb/paper.hpp>
#include <rrcb/quality.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rrcb {

namespace {

/// Throws Error unless there is a size for each part, or none at all.
void check_part_sizes(std::span<const double> part_weights, std::span<const double> part_sizes) {
    require(part_sizes.empty() || part_sizes.size() == part_weights.size(),
            "part_sizes must hold one entry per part, or none for equal parts");
}

}  // namespace

double imbalance(std::span<const double> part_weights, std::span<const double> part_sizes) {
    if (part_weights.empty()) return 1;
    check_part_sizes(part_weights, part_sizes);
    const double total = std::accumulate(part_weights.begin(), part_weights.end(), 0.0);
    if (!std::isfinite(total)) return std::numeric_limits<double>::quiet_NaN();
    const double sizes = std::accumulate(part_sizes.begin(), part_sizes.end(), 0.0);
    double worst = 0;
    for (std::size_t p = 0; p < part_weights.size(); ++p) {
        const double ideal = part_sizes.empty() ? 1 / static_cast<double>(part_weights.size())
                                                : part_sizes[p] / sizes;
        worst = std::max(worst, over_ideal(part_weights[p], total, ideal));
    }
    return worst > 0 ? worst : 1;
}

std::vector<double> load_unbalance_percent(std::span<const double> part_weights,
                                           std::span<const double> part_sizes) {
    check_part_sizes(part_weights, part_sizes);
    std::vector<double> unbalance =
        locally([&] { return std::vector<double>(part_weights.size()); });
    const double total = std::accumulate(part_weights.begin(), part_weights.end(), 0.0);
    const double sizes = std::accumulate(part_sizes.begin(), part_sizes.end(), 0.0);
    for (std::size_t p = 0; p < unbalance.size(); ++p) {
        const double ideal = part_sizes.empty() ? total / static_cast<double>(unbalance.size())
                                                : total * (part_sizes[p] / sizes);
        unbalance[p] = ideal > 0 ? (ideal - part_weights[p]) / ideal * 100 : 0;
    }
    return unbalance;
}

}  // namespace rrcb
