#pragma once

#include "collective/saved_state.hpp"
#include "controller/cost_guard.hpp"
#include "controller/nonnegative_fit.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace rrcb {

/// Learns costs: the share of one rank. Does not communicate.
///
/// After each step a rank contributes sums, and receives those of all ranks one step later. Rank 0
/// fits costs to them and judges their predictions. It adds costs and judgement to the sums of the
/// next step, and the others add 0: costs are bit-identical on all ranks.
class CostRule {
  public:
    CostRule(int num_columns, int rank, int num_ranks);

    std::size_t num_columns() const { return static_cast<std::size_t>(num_columns_); }

    /// Returns the number of a rank's doubles, to be joined by join_carried().
    std::size_t num_sums() const { return sums_.size(); }

    /// Returns this rank's sums for a step.
    std::span<const double> hand_in(double seconds, std::span<const double> columns);

    /// Takes the sums of all ranks for the last step.
    void take(std::span<const double> all);

    /// The results from here on are the same on all ranks.
    const CostVector& costs() const { return costs_; }
    double weight(std::span<const double> columns) const;
    bool uses_costs() const { return state_ == CostState::learned; }
    CostState state() const { return state_; }
    double learned_error() const { return learned_error_; }
    double counted_error() const { return counted_error_; }

    /// Notes that the points are divided by the present weights.
    void divide() { is_learned_ = uses_costs(); }

    /// Numbers of this rank only, for save() and load().
    std::array<double, 3> own_numbers() const { return {seconds_, columns_[0], learned_}; }
    void set_own_numbers(std::span<const double> numbers);
    /// Writes or reads the rest. On rank 0, when it writes.
    void store(SavedState& state);
    /// Goes on with costs learned on another number of ranks.
    void change_ranks(int before);

  private:
    void note_errors(std::span<const double> all);
    void learn(std::span<const double> all);
    double without_outlier(double seconds) const;
    bool knows_columns() const;

    Eigen::Index num_columns_;
    int rank_;
    int num_ranks_;
    std::vector<double> sums_;

    CostVector seen_;     ///< sums of squared columns of all ranks, with forgetting
    CostVector known_;    ///< such sums when the costs were last fitted
    CostVector columns_;  ///< of the last step
    double seconds_ = 0;  ///< of the last step
    double learned_ = 0;  ///< seconds predicted for the last step
    double kept_seconds_ = 0;
    double scatter_ = -1;        ///< rms error of a share, outliers cut off; negative: unknown
    double mean_ = 0;            ///< seconds of a rank in the step before
    double learned_square_ = 0;  ///< squared errors of the step before, to be contributed
    double counted_square_ = 0;
    double between_square_ = 0;  ///< squared difference of both predictions

    NormalEquations all_;  ///< of all ranks; fed only on rank 0, as is the next
    CostGuard guard_;
    bool is_learned_ = false;   ///< the points are divided by learned costs
    bool was_learned_ = false;  ///< in the contributed step

    CostVector costs_;
    CostState state_;
    double learned_error_ = 0;
    double counted_error_ = 0;
};

}  // namespace rrcb
