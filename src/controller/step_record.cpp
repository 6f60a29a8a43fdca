#include "controller/step_record.hpp"

#include <rrcb/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace rrcb {

namespace {

constexpr std::int64_t most_ranks = std::int64_t{1} << 31;

std::string whole(double number) {
    return std::to_string(static_cast<std::int64_t>(number));
}

std::string text_of(BadInput input) {
    if (input == BadInput::columns)
        return ": a step has no columns, or another number than the cost model; give as many";
    return std::string(input == BadInput::load ? ": the load, the points or a column of a step are"
                                               : ": the cost of a rebalance is") +
           " negative, NaN or infinite; give a finite number of at least 0";
}

}  // namespace

double code_of(int rank, BadInput input) {
    return static_cast<double>(4 * (most_ranks - rank) + static_cast<int>(input));
}

void join(const StepRecord& theirs, StepRecord& ours) {
    ours.work += theirs.work;
    ours.mean_load += theirs.mean_load;
    ours.weight += theirs.weight;
    for (double StepRecord::*field :
         {&StepRecord::heaviest_load, &StepRecord::cost, &StepRecord::least_imbalance,
          &StepRecord::is_due, &StepRecord::bad_input, &StepRecord::num_rebalances,
          &StepRecord::minus_num_rebalances, &StepRecord::offered})
        ours.*field = std::max(ours.*field, theirs.*field);
}

void join_carried(std::span<const double> theirs, std::span<double> ours) {
    if (ours.empty()) return;
    const double largest = std::max(ours.back(), theirs.back());
    for (std::size_t k = 0; k < ours.size(); ++k) ours[k] += theirs[k];
    ours.back() = largest;
}

bool is_amount(double value) {
    return std::isfinite(value) && value >= 0;
}

void check_record(const StepRecord& all) {
    std::string text;
    if (all.num_rebalances != -all.minus_num_rebalances) {
        text = "rebalanced() was called " + whole(-all.minus_num_rebalances) +
               " times on one rank and " + whole(all.num_rebalances) +
               " times on another; call it on every rank after each rebalance";
    } else if (all.bad_input > 0) {
        const auto code = static_cast<std::int64_t>(all.bad_input);
        text = "rank " + std::to_string(most_ranks - code / 4) +
               text_of(static_cast<BadInput>(code % 4));
    }
    if (!text.empty()) throw Error(ErrorCode::invalid_argument, text);
}

}  // namespace rrcb
