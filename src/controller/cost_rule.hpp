#pragma once

#include "collective/saved_state.hpp"
#include "controller/cost_guard.hpp"
#include "controller/nonnegative_fit.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace rrcb {

/// Learns costs. This class is the part of one rank, and does not communicate.
///
/// After each step a rank contributes sums, and one step later it receives the sums of all ranks.
/// Rank 0 fits costs to them and judges their predictions. It adds the costs and its judgement to
/// the sums of the next step, to which the others add 0. Costs are therefore bit-identical on all
/// ranks.
class CostRule {
  public:
    CostRule(int num_columns, int rank, int num_ranks);

    std::size_t num_columns() const { return num_columns_; }

    /// Returns the number of doubles that each rank contributes; join_carried() joins them.
    std::size_t num_sums() const { return sums_.size(); }

    /// Returns this rank's sums for a step.
    std::span<const double> hand_in(double seconds, std::span<const double> columns);

    /// Processes the sums of all ranks for the last step.
    void take(std::span<const double> all);

    /// The following functions return the same results on all ranks.
    const CostVector& costs() const { return costs_; }
    double weight(std::span<const double> columns) const;
    bool uses_costs() const { return state_ == CostState::learned; }
    CostState state() const { return state_; }
    double learned_error() const { return learned_error_; }
    double counted_error() const { return counted_error_; }

    /// Notes that the points have been divided by the present weights.
    void divide() { is_learned_ = uses_costs(); }

    /// For save() and load(): the numbers that differ between ranks.
    std::array<double, 3> own_numbers() const { return {seconds_, columns_[0], learned_}; }
    void set_own_numbers(std::span<const double> numbers);
    /// Writes or reads all other numbers. Writing is only for rank 0.
    void store(SavedState& state);
    /// Adapts costs that were learned on `before` ranks to the present number of ranks.
    void change_ranks(int before);

  private:
    void note_errors(std::span<const double> all);
    void learn(std::span<const double> all);
    double without_outlier(double seconds) const;
    bool knows_columns() const;

    std::size_t num_columns_;
    int rank_;
    int num_ranks_;
    std::vector<double> sums_;

    CostVector seen_;     ///< sums of squared columns of all ranks; older steps count less and less
    CostVector known_;    ///< these sums when the costs were last fitted
    CostVector columns_;  ///< columns of the last step
    double seconds_ = 0;  ///< seconds of the last step
    double learned_ = 0;  ///< predicted seconds of the last step
    double kept_seconds_ = 0;
    double scatter_ = -1;  ///< rms error of a rank's share, without outliers; negative if unknown
    double mean_ = 0;      ///< mean seconds of the ranks in the step before the last
    double learned_square_ = 0;  ///< squared error in the step before the last, still to be
                                 ///< contributed
    double counted_square_ = 0;
    double between_square_ = 0;  ///< squared difference of both predictions

    NormalEquations all_;  ///< equations of all ranks; used only on rank 0, as is guard_
    CostGuard guard_;
    bool is_learned_ = false;   ///< whether the points were divided by learned costs
    bool was_learned_ = false;  ///< the same for the contributed step

    CostVector costs_;
    CostState state_;
    double learned_error_ = 0;
    double counted_error_ = 0;
};

}  // namespace rrcb
