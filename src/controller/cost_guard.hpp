#pragma once

namespace rrcb {

/// Reason to weigh points by learned costs or to count them.
enum class CostState { too_early, one_rank, no_better, harmful, learned };

/// Decides whether learned costs may be used, from their predictions and from the imbalance that
/// they lead to. Errors are those of the ranks' shares of a step's seconds, as sums of squares over
/// the ranks.
class CostGuard {
  public:
    explicit CostGuard(int num_ranks) : num_ranks_(num_ranks) {}

    /// Adds the errors of a step that was not used for learning. `between` is the sum of squared
    /// differences of both predictions.
    void add_errors(double learned, double counted, double between);

    /// Adds slowest rank / mean - 1 of a step; `is_learned`: its points were divided by learned
    /// costs.
    void add_excess(double excess, bool is_learned);

    CostState state() const;
    double learned_error() const { return rms(learned_error_); }
    double counted_error() const { return rms(counted_error_); }

    /// Goes on with errors added up on another number of ranks.
    void change_ranks(int before);

    /// Writes or reads this.
    void store(auto& state) {
        state.each(num_steps_, learned_error_, counted_error_, between_, weight_, predicts_,
                   excess_, excess_weight_, loss_, barred_until_);
    }

  private:
    double rms(double sum) const;

    int num_ranks_;
    double num_steps_ = 0;
    double learned_error_ = 0;  ///< with forgetting, as is the next
    double counted_error_ = 0;
    double between_ = 0;
    double weight_ = 0;  ///< of the steps in them
    bool predicts_ = false;

    double excess_ = 0;         ///< mean excess while points were counted, with forgetting
    double excess_weight_ = 0;  ///< of the steps in it
    double loss_ = 0;           ///< excess due to learned costs, in steps
    double barred_until_ = 0;   ///< number of steps before which learned costs are not used
};

}  // namespace rrcb
