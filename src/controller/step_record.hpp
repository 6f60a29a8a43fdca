#pragma once

#include <span>

namespace rrcb {

/// Invalid input of a rank.
enum class BadInput { none, load, cost, columns };

/// Step of one rank, or of all joined: shares are added, other fields take the largest value. A
/// minimum is sent as the negative of a maximum.
struct StepRecord {
    double work = 0;       ///< share of the mean load as measured
    double mean_load = 0;  ///< share of the mean of the compared loads
    double weight = 0;     ///< share of the mean weight of the points
    double heaviest_load = 0;
    double cost = 0;  ///< of the rebalances since the step before
    double least_imbalance = 1;
    double is_due = 0;     ///< the root's decision; 0 from all others
    double bad_input = 0;  ///< code_of() that of the lowest rank
    double num_rebalances = 0;
    double minus_num_rebalances = 0;
};

/// Returns the code of invalid input, larger for lower ranks.
double code_of(int rank, BadInput input);

/// Adds the step of other ranks.
void join(const StepRecord& theirs, StepRecord& ours);

/// Adds the carried sums of other ranks; the last one becomes the larger of both.
void join_carried(std::span<const double> theirs, std::span<double> ours);

bool is_amount(double value);

/// Throws the Error of a step of all ranks, the same on every rank.
void check_record(const StepRecord& all);

}  // namespace rrcb
