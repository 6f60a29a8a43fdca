#include "bisection/profile.hpp"

#include "arithmetic/infinity.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rrcb {

namespace {

constexpr std::size_t num_profile_bins = 128;

}  // namespace

bool Profile::Range::is_limited() const {
    return std::isfinite(lower) || std::isfinite(upper);
}

Profile::Profile(const StatisticalDomain& domain, int axis, std::size_t few)
    : domain_(&domain), axis_(axis) {
    if (domain.patches.size() < few) return;
    lower_ = infinity;
    upper_ = -infinity;
    for (const Patch& patch : domain.patches) {
        lower_ = std::min(lower_, patch.lower[axis]);
        upper_ = std::max(upper_, patch.upper[axis]);
    }
    const double bins_per_half = num_profile_bins / (upper_ / 2 - lower_ / 2);
    if (!(bins_per_half > 0 && std::isfinite(bins_per_half))) return;
    const auto bin_of = [&](double value) {
        const double bin = std::max(0.0, (value / 2 - lower_ / 2) * bins_per_half);
        return std::min(num_profile_bins - 1, static_cast<std::size_t>(bin));
    };
    // First the difference of each bin from the one before, at index bin + 1. One partial sum gives
    // the weights of the bins, a second one the weights below their edges.
    weights_below_.resize(num_profile_bins + 2);
    for (const Patch& patch : domain.patches) {
        const std::size_t first = bin_of(patch.lower[axis]);
        const std::size_t last = bin_of(patch.upper[axis]);
        const double each = patch.weight / static_cast<double>(last - first + 1);
        weights_below_[first + 1] += each;
        weights_below_[last + 2] -= each;
    }
    weights_below_.pop_back();
    for (int k = 0; k < 2; ++k)
        std::partial_sum(weights_below_.begin(), weights_below_.end(), weights_below_.begin());
}

Profile::Range Profile::range_of(double target) const {
    constexpr std::ptrdiff_t margin = 1;  // bins
    if (weights_below_.empty()) return {};
    const auto passes = [&](double below) { return below >= target; };
    const auto passed = std::ranges::find_if(weights_below_, passes) - weights_below_.begin();
    const auto edge = [&](std::ptrdiff_t k) {
        return std::lerp(lower_, upper_, static_cast<double>(k) / num_profile_bins);
    };
    Range range;
    if (passed - 1 - margin > 0) range.lower = edge(passed - 1 - margin);
    if (passed + margin < std::ssize(weights_below_) - 1) range.upper = edge(passed + margin);
    return range;
}

double Profile::weight_near(double target, double reach) const {
    if (weights_below_.empty() || !(reach > 0)) return 0;
    const auto passed = std::ranges::lower_bound(weights_below_, target) - weights_below_.begin();
    const double reach_in_bins = num_profile_bins * (reach / (upper_ - lower_));
    const auto below = [&](double edge) {
        const double inside = std::clamp(edge, 0.0, static_cast<double>(num_profile_bins));
        const auto first = std::min(num_profile_bins - 1, static_cast<std::size_t>(inside));
        return std::lerp(weights_below_[first], weights_below_[first + 1],
                         inside - static_cast<double>(first));
    };
    const double middle = static_cast<double>(passed) - 0.5;
    return below(middle + reach_in_bins) - below(middle - reach_in_bins);
}

}  // namespace rrcb
