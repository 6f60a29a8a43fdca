#include "controller/cost_rule.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

constexpr double forgetting = 1 - 1.0 / 100;
/// Seconds are limited to this multiple of the usual error around their prediction.
constexpr double usual = 3;
/// The limit is never less than this share of the mean seconds.
constexpr double least_reach = 0.1;

/// Index of each sum. After these follow the normal equations, rank 0's costs, and the seconds of
/// the slowest rank.
enum HeadOfSums : std::size_t {
    seconds_sum,
    learned_sum,
    counted_sum,
    learned_square,
    counted_square,
    between_square,
    cut_square,
    state_of_root,
    learned_of_root,
    counted_of_root,
    head_size
};

}  // namespace

CostRule::CostRule(int num_columns, int rank, int num_ranks)
    : num_columns_(static_cast<std::size_t>(num_columns)),
      rank_(rank),
      num_ranks_(num_ranks),
      sums_(head_size + num_columns_ * (num_columns_ + 2) + 1),
      seen_(num_columns_),
      known_(seen_),
      columns_(num_columns_),
      all_(num_columns_),
      guard_(num_ranks),
      costs_(num_columns_),
      state_(guard_.state()) {}

/// Returns false if a column was 0, or nearly 0, in the steps from which the costs were fitted. The
/// cost of this column cannot be predicted then, so seconds beyond the prediction need not be
/// outliers.
bool CostRule::knows_columns() const {
    for (std::size_t j = 0; j < num_columns_; ++j)
        if (columns_[j] * columns_[j] > known_[j]) return false;
    return true;
}

/// Returns the seconds, limited to a range around the prediction, so that a single stall does not
/// spoil the fit.
double CostRule::without_outlier(double seconds) const {
    if (scatter_ < 0 || !knows_columns()) return seconds;
    const double reach = std::max(usual * scatter_, least_reach) * mean_;
    return std::clamp(seconds, learned_ - reach, learned_ + reach);
}

std::span<const double> CostRule::hand_in(double seconds, std::span<const double> columns) {
    std::copy(columns.begin(), columns.end(), columns_.begin());
    seconds_ = seconds;
    was_learned_ = is_learned_;
    learned_ = weight(columns_);
    kept_seconds_ = without_outlier(seconds);
    const bool is_root = rank_ == 0;
    sums_[seconds_sum] = seconds_;
    sums_[learned_sum] = learned_;
    sums_[counted_sum] = columns_[0];
    sums_[learned_square] = learned_square_;
    sums_[counted_square] = counted_square_;
    sums_[between_square] = between_square_;
    const double cut = knows_columns() ? kept_seconds_ - learned_ : 0;
    sums_[cut_square] = mean_ > 0 ? cut * cut / (mean_ * mean_) : 0;
    sums_[state_of_root] = is_root ? static_cast<double>(guard_.state()) : 0;
    sums_[learned_of_root] = is_root ? guard_.learned_error() : 0;
    sums_[counted_of_root] = is_root ? guard_.counted_error() : 0;
    double* next = sums_.data() + head_size;
    for (const double first : columns_) {
        *next++ = first * kept_seconds_;
        for (const double second : columns_) *next++ = first * second;
    }
    const CostVector fitted = is_root ? fitted_costs(all_) : CostVector(num_columns_);
    *std::copy(fitted.begin(), fitted.end(), next) = seconds_;
    return sums_;
}

void CostRule::take(std::span<const double> all) {
    const double mean = all[seconds_sum] / num_ranks_;
    if (rank_ == 0) {
        guard_.add_errors(all[learned_square], all[counted_square], all[between_square]);
        if (mean > 0) guard_.add_excess(all.back() / mean - 1, was_learned_);
    }
    state_ = static_cast<CostState>(static_cast<int>(all[state_of_root]));
    learned_error_ = all[learned_of_root];
    counted_error_ = all[counted_of_root];
    std::ranges::copy(all.last(num_columns_ + 1).first(num_columns_), costs_.begin());
    note_errors(all);
    known_ = seen_;
    for (std::size_t j = 0; j < num_columns_; ++j)
        seen_[j] = forgetting * seen_[j] + all[head_size + j * (num_columns_ + 2) + 1];
    if (rank_ == 0) learn(all);
    mean_ = mean;
}

double CostRule::weight(std::span<const double> columns) const {
    double sum = 0;
    for (std::size_t j = 0; j < num_columns_; ++j) sum += costs_[j] * columns[j];
    return sum;
}

void CostRule::note_errors(std::span<const double> all) {
    learned_square_ = counted_square_ = between_square_ = 0;
    if (!(all[seconds_sum] > 0) || !(all[counted_sum] > 0)) return;
    const double share = seconds_ / all[seconds_sum] * num_ranks_;
    const double counted = share - columns_[0] / all[counted_sum] * num_ranks_;
    counted_square_ = counted * counted;
    learned_square_ = counted_square_;
    if (!(all[learned_sum] > 0)) return;
    const double learned = share - learned_ / all[learned_sum] * num_ranks_;
    learned_square_ = learned * learned;
    between_square_ = (counted - learned) * (counted - learned);
    const double cut = all[cut_square] / num_ranks_;
    constexpr double kept = 1 - 1.0 / 50;
    if (mean_ > 0)
        scatter_ = scatter_ < 0 ? std::sqrt(cut)
                                : std::sqrt(kept * scatter_ * scatter_ + (1 - kept) * cut);
}

void CostRule::learn(std::span<const double> all) {
    const double* next = all.data() + head_size;
    for (std::size_t i = 0; i < num_columns_; ++i) {
        all_.products[i] = forgetting * all_.products[i] + *next++;
        for (std::size_t j = 0; j < num_columns_; ++j)
            all_.squares(i, j) = forgetting * all_.squares(i, j) + *next++;
    }
}

void CostRule::set_own_numbers(std::span<const double> numbers) {
    seconds_ = numbers[0];
    columns_[0] = numbers[1];
    learned_ = numbers[2];
}

void CostRule::store(SavedState& state) {
    const std::span squares = all_.squares.numbers();
    state.each(seen_, known_, costs_, scatter_, mean_, squares, all_.products, guard_, is_learned_,
               was_learned_, learned_error_, counted_error_);
    auto state_of_costs = static_cast<std::size_t>(state_);
    state.count(state_of_costs, static_cast<std::size_t>(CostState::learned));
    state_ = static_cast<CostState>(state_of_costs);
}

void CostRule::change_ranks(int before) {
    guard_.change_ranks(before);
    state_ = guard_.state();
    scatter_ = -1;
}

}  // namespace rrcb
