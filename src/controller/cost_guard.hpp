#pragma once

namespace rrcb {

/// Reason why points are weighed by learned costs, or only counted.
enum class CostState { too_early, one_rank, no_better, harmful, learned };

/// Decides whether learned costs may be used, from their predictions and from the imbalance that
/// results from using them. Errors refer to the ranks' shares of a step's seconds, as sums of
/// squares over the ranks.
class CostGuard {
  public:
    explicit CostGuard(int num_ranks) : num_ranks_(num_ranks) {}

    /// Adds the errors of predictions for a step from which nothing had been learned yet. `between`
    /// is the sum of the squared differences between both predictions.
    void add_errors(double learned, double counted, double between);

    /// Adds the excess of a step: (slowest rank / mean) - 1. `is_learned` means that its points
    /// were divided by learned costs.
    void add_excess(double excess, bool is_learned);

    CostState state() const;
    double learned_error() const { return rms(learned_error_); }
    double counted_error() const { return rms(counted_error_); }

    /// Adapts errors that were added up on `before` ranks to the present number of ranks.
    void change_ranks(int before);

    /// Writes or reads all members.
    void store(auto& state) {
        state.each(num_steps_, learned_error_, counted_error_, between_, weight_, predicts_,
                   excess_, excess_weight_, loss_, barred_until_);
    }

  private:
    double rms(double sum) const;

    int num_ranks_;
    double num_steps_ = 0;
    double learned_error_ = 0;  ///< older steps count less and less, as in the next two
    double counted_error_ = 0;
    double between_ = 0;
    double weight_ = 0;  ///< weight of the steps in these errors
    bool predicts_ = false;

    double excess_ = 0;  ///< mean excess while points were counted; older steps count less and less
    double excess_weight_ = 0;  ///< weight of the steps in this mean
    double loss_ = 0;           ///< additional excess because of learned costs, in steps
    double barred_until_ = 0;   ///< learned costs are not used before this number of steps
};

}  // namespace rrcb
