#pragma once

namespace rrcb {

/// Step of one rank, or of all: the mean loads add up, of the others the largest counts. A smallest
/// value travels as the largest of its negative.
struct StepRecord {
    double mean_load = 0;  ///< this rank's share of it
    double heaviest_load = 0;
    double cost = 0;  ///< of the rebalances since the step before
    double least_imbalance = 1;
    double is_due = 0;     ///< the root's decision; 0 from all others
    double bad_input = 0;  ///< 2 rank + 1 for a load, + 2 for a cost
    double num_rebalances = 0;
    double minus_num_rebalances = 0;
};

/// Adds the step of other ranks.
void join(const StepRecord& theirs, StepRecord& ours);

bool is_amount(double value);

/// Throws the Error of a step of all ranks, the same on every rank.
void check_record(const StepRecord& all);

}  // namespace rrcb
