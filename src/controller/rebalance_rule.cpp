#include "controller/rebalance_rule.hpp"

#include <algorithm>

namespace rrcb {

namespace {

/// Excess that equal loads may have because of rounding.
constexpr double rounding = 1e-12;

/// An excess is expected to last four times as long as it has lasted so far.
constexpr double foresight = 4;

/// When the waste reaches this multiple of a rebalance's cost, a rebalance is tried even if earlier
/// ones did not help.
constexpr double patience = 8;

/// The first rebalance may be much more expensive than later ones, so only this share of its cost
/// counts.
constexpr double share_of_first = 1.0 / 3;

constexpr std::size_t start_length = 2;  ///< 2^2 steps

/// Returns the median of the first `count` values; of two values, the smaller one.
double median(const std::array<double, 3>& values, std::size_t count) {
    const auto [less, greater] = std::minmax({values[0], values[count > 1 ? 1 : 0]});
    return count < 3 ? less : std::clamp(values[2], less, greater);
}

}  // namespace

StepLoad smoothed_load(double work, double mean, double heaviest) {
    return {work, mean > 0 ? work * std::max(1.0, heaviest / mean) : work};
}

void RebalanceRule::add(const StepLoad& load) {
    if (!(load.mean > 0)) return;
    if (!(unit_ > 0)) unit_ = load.mean;
    const Waste step{(load.heaviest - load.mean) / unit_, load.mean / unit_};
    latest_.add(step);
    cycle_.add(step);
    const std::size_t start = std::size_t{1} << start_length;
    if (latest_.count() > start && latest_.count() % start == 0)
        busiest_ = std::max(busiest_, latest_.block(start_length).work);
}

void RebalanceRule::rebalanced(double cost, double least_imbalance) {
    if (num_rebalances_ > 0 && cycle_.count() > 0) {
        if (knows_rebalances_) earlier_.remember(cycle_, latest_.lasting());
        if (busiest_ > 0) slow_start_ = std::max(0.0, cycle_.first(start_length).work - busiest_);
    }
    costs_[num_rebalances_++ % costs_.size()] = cost;
    least_ = least_imbalance - 1;
    knows_rebalances_ = true;
    latest_ = {};
    cycle_ = {};
    busiest_ = 0;
}

void RebalanceRule::expect_less() {
    earlier_ = {};
    knows_rebalances_ = false;
}

/// Returns how much more work the first steps of the cycle are than the largest sum of as many
/// later ones, in units. A rebalance may slow them down, for example because caches are cold. The
/// result is at most that of the last cycle, because the first steps may be slow for another
/// reason.
double RebalanceRule::slow_start() const {
    if (!(busiest_ > 0)) return slow_start_;
    return std::clamp(cycle_.first(start_length).work - busiest_, 0.0, slow_start_);
}

/// Returns the expected cost of the next rebalance, in units: the cost of the latest one, limited
/// if it is an outlier, plus the slow steps that follow.
double RebalanceRule::cost() const {
    if (num_rebalances_ == 0) return cycle_.total().work / static_cast<double>(cycle_.count());
    const double middle = median(costs_, std::min(num_rebalances_, costs_.size()));
    const double latest = costs_[(num_rebalances_ - 1) % costs_.size()];
    const double share = num_rebalances_ == 1 ? share_of_first : 1;
    return share * std::clamp(latest, middle / 2, 2 * middle) / unit_ + slow_start();
}

/// Returns whether a rebalance pays if the `excess` has lasted for `lasted` steps.
bool RebalanceRule::pays(double excess, double lasted, const Prospect& next) const {
    if (excess <= std::max(least_, rounding)) return false;
    const double horizon = foresight * lasted;
    double gain = horizon * excess;
    if (knows_rebalances_)
        gain = std::max({cycle_.gain(excess, horizon), earlier_.gain(excess, horizon),
                         lasted * (excess - next.least_excess) / patience});
    return gain * next.mean > std::max(next.cost, rounding * horizon * next.mean);
}

bool RebalanceRule::is_due() const {
    if (!latest_.has(0)) return false;
    const Prospect next{cycle_.total().work / static_cast<double>(cycle_.count()), cost(),
                        std::min(cycle_.least_excess(), earlier_.least_excess())};
    for (std::size_t k = 0; latest_.has(k); ++k)
        if (pays(latest_.lasting(k), LatestSteps::num_blocks * steps_of(k), next)) return true;
    return false;
}

}  // namespace rrcb
