#include "controller/rebalance_rule.hpp"

#include <algorithm>
#include <limits>

namespace rrcb {

namespace {

/// Excess that equal loads may show.
constexpr double rounding = 1e-12;

}  // namespace

void RebalanceRule::add(const StepLoad& load) {
    if (!(load.mean > 0)) return;
    if (!(unit_ > 0)) unit_ = load.mean;
    window_.add(load.heaviest / load.mean - 1, load.mean / unit_);
    history_.add(window_.excess(), window_.mean());
    if (num_rebalances_ == 0) return;
    // The first steps may be slow for reasons of their own: what later ones fall to counts, too.
    constexpr std::size_t settled = 3;
    double& floor = floors_[(num_rebalances_ - 1) % floors_.size()];
    floor = window_.count() <= settled ? window_.excess() : std::min(floor, window_.upper_bound());
}

void RebalanceRule::rebalanced(double cost, double least_imbalance) {
    if (window_.count() > 0) end_cycle();
    if (expects_less_) floors_.fill(std::numeric_limits<double>::infinity());
    expects_less_ = false;
    floors_[num_rebalances_ % floors_.size()] = std::numeric_limits<double>::infinity();
    costs_[num_rebalances_++ % costs_.size()] = cost;
    least_ = least_imbalance - 1;
}

void RebalanceRule::end_cycle() {
    const double work = history_.work();
    const double waste = history_.waste();
    if (num_rebalances_ > 0) {
        past_ = {past_.cycles / 2 + 1, past_.work / 2 + work, past_.waste / 2 + waste};
        const bool has_paid = cost() + waste < left_ * work;
        patience_ = has_paid || num_rebalances_ == 1 ? 1 : 2 * patience_;
    }
    left_ = lasting_excess();
    window_.clear();
    history_.clear();
}

/// Of the next rebalance, in units: that of the latest, unless it is an outlier.
double RebalanceRule::cost() const {
    if (num_rebalances_ == 0) return window_.mean();
    const double middle = median(costs_, num_rebalances_);
    const double latest = costs_[(num_rebalances_ - 1) % costs_.size()];
    return std::clamp(latest, middle / 2, 2 * middle) / unit_;
}

/// Excess that the rebalances have not removed.
double RebalanceRule::floor() const {
    const auto count = static_cast<std::ptrdiff_t>(std::min(num_rebalances_, floors_.size()));
    if (count == 0 || expects_less_) return 0;
    return *std::min_element(floors_.begin(), floors_.begin() + count);
}

/// Of rebalances and waste in this cycle, if it ended now, and those before it, over the work.
double RebalanceRule::mean_cost() const {
    const double waste = past_.waste + history_.waste();
    return ((past_.cycles + 1) * cost() + waste) / (past_.work + history_.work());
}

double RebalanceRule::lasting_excess() const {
    const double level = window_.lower_bound();
    return std::min(level, history_.mean_since(level));
}

bool RebalanceRule::is_due() const {
    constexpr std::size_t fewest = 3;
    if (window_.count() < fewest) return false;
    const double excess = lasting_excess();
    if (excess <= std::max({floor(), least_, rounding})) return false;
    return excess >= mean_cost() || history_.lasting_waste(floor()) >= patience_ * cost();
}

}  // namespace rrcb
