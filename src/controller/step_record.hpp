#pragma once

#include <limits>
#include <span>

namespace rrcb {

/// Kind of a rank's invalid input.
enum class BadInput { none, load, cost, columns };

/// Stands for no number that the caller gave.
inline constexpr double none_offered = -std::numeric_limits<double>::infinity();

/// Step of one rank, or the joined steps of all ranks. Shares are added up; all other fields take
/// the maximum. A minimum is sent as the maximum of the negative.
struct StepRecord {
    double work = 0;       ///< this rank's share of the measured mean load
    double mean_load = 0;  ///< this rank's share of the mean of the loads that are compared
    double weight = 0;     ///< this rank's share of the mean weight of the points
    double heaviest_load = 0;
    double cost = 0;  ///< cost of the rebalances since the previous step
    double least_imbalance = 1;
    double is_due = 0;     ///< decision of the root; 0 on all other ranks
    double bad_input = 0;  ///< code_of() the bad input; the maximum is that of the lowest rank
    double num_rebalances = 0;
    double minus_num_rebalances = 0;
    double offered = none_offered;  ///< number that the caller gave; must stay the last field
};

/// Returns the code of invalid input. Lower ranks have larger codes.
double code_of(int rank, BadInput input);

/// Joins the step of other ranks to ours.
void join(const StepRecord& theirs, StepRecord& ours);

/// Adds the carried sums of other ranks. The last one is not added, but becomes the larger of both.
void join_carried(std::span<const double> theirs, std::span<double> ours);

bool is_amount(double value);

/// If the joined step contains an error of any rank, throws the same Error on every rank.
void check_record(const StepRecord& all);

}  // namespace rrcb
