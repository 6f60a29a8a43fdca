#include "controller/cost_guard.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

/// Factor of each step that makes about 200 steps count. With 100 steps, noise of 7 % would hide it
/// if costs predict seconds to 4 %.
constexpr double guard_forgetting = 1 - 1.0 / 200;
constexpr double fewest = 10;  ///< least number of steps before learned costs are used
/// Learned costs are used only if their gain is at least this multiple of the standard deviation of
/// noise.
constexpr double certainty = 3;
/// They are used only if their gain is at least this share of the squared error of counting.
constexpr double margin = 0.02;
/// Learned costs are put aside when they have lost this share of all steps.
constexpr double allowed_loss = 0.005;

}  // namespace

void CostGuard::add_errors(double learned, double counted, double between) {
    learned_error_ = guard_forgetting * learned_error_ + learned;
    counted_error_ = guard_forgetting * counted_error_ + counted;
    between_ = guard_forgetting * between_ + between;
    weight_ = guard_forgetting * weight_ + 1;
    // If the noise of the ranks is independent, the standard deviation of the gain is twice the
    // noise times the difference of the predictions.
    const double gain = counted_error_ - learned_error_;
    const double noise = 2 * std::sqrt(between_ * learned_error_ / (weight_ * num_ranks_));
    const double needed = predicts_ ? 0 : std::max(certainty * noise, margin * counted_error_);
    predicts_ = num_steps_ >= fewest && gain > needed;
}

void CostGuard::add_excess(double excess, bool is_learned) {
    ++num_steps_;
    // This limits the effect of a single slow step.
    excess = std::min(excess, 1.0);
    if (!is_learned) {
        excess_ += (excess - excess_) / std::min(++excess_weight_, 50.0);
        loss_ = 0;
        return;
    }
    loss_ = std::max(0.0, loss_ + excess - excess_);
    if (loss_ <= 1 + allowed_loss * num_steps_) return;
    barred_until_ = 2 * num_steps_;
    loss_ = 0;
}

CostState CostGuard::state() const {
    if (num_ranks_ == 1) return CostState::one_rank;
    if (num_steps_ < fewest) return CostState::too_early;
    if (num_steps_ < barred_until_) return CostState::harmful;
    return predicts_ ? CostState::learned : CostState::no_better;
}

void CostGuard::change_ranks(int before) {
    const double factor = 1.0 * num_ranks_ / before;
    for (double* sum : {&learned_error_, &counted_error_, &between_}) *sum *= factor;
    loss_ = 0;
}

double CostGuard::rms(double sum) const {
    return weight_ > 0 ? std::sqrt(sum / (weight_ * num_ranks_)) : 0;
}

}  // namespace rrcb
