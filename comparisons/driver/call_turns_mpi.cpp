#include "call_turns_mpi.hpp"

#include "failure.hpp"
#include "partitioner_mpi.hpp"
#include "phase_log_mpi.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace comparisons {

CallTurns::CallTurns(MovingPoints& points, std::span<const Method> methods, const Plan& plan,
                     MPI_Comm comm)
    : points_(points), plan_(plan), comm_(comm) {
    plan_.every = std::max(plan.every, static_cast<int>(methods.size()) + 1);
    for (const Method& method : methods) {
        std::optional<mpm::Balancer> balancer = make_balancer(method);
        if (!balancer) throw Failure("method '" + method.label + "' makes no boxes");
        callers_.push_back({*std::move(balancer), {}, {}});
        callers_.back().costs.resize(static_cast<std::size_t>(plan.num_windows));
    }
}

int CallTurns::start_of(int window) const {
    return static_cast<int>(static_cast<double>(window) / plan_.num_windows * points_.num_steps());
}

/// A caller is called `number` steps after its turn begins. It gets its points back before the step
/// before that, which leaves caches as a step does. The first turn of a window makes the parts that
/// the next one begins with.
void CallTurns::act_before(int step) {
    for (int window = 0; window < plan_.num_windows; ++window) {
        for (int number = 0; number < static_cast<int>(callers_.size()); ++number) {
            const int since = step - start_of(window) - number;
            Caller& caller = callers_[static_cast<std::size_t>(number)];
            const int end = plan_.num_turns * plan_.every;
            if (since >= 0 && since <= end && since % plan_.every == 0) {
                const RebalanceCost cost = timed_rebalance(caller.balancer);
                caller.made = points_.decomposition();
                if (since > 0) caller.costs[static_cast<std::size_t>(window)].push_back(cost);
            }
            if (since >= 0 && since < end && (since + 1) % plan_.every == 0) give_back(caller);
        }
    }
}

void CallTurns::give_back(const Caller& caller) {
    points_.rebalance([&caller](mpm::Positions, MPI_Comm) {
        return mpm::Decomposition{caller.made.boxes, caller.made.owners, {}};
    });
}

RebalanceCost CallTurns::timed_rebalance(const mpm::Balancer& balancer) {
    int num_ranks = 1;
    MPI_Comm_size(comm_, &num_ranks);
    PhaseLog log;
    mpm::Decomposition parts;
    MPI_Barrier(comm_);
    log.record([&] { parts = balancer(points_.positions(), comm_); });
    const double call_s = log.last_s(num_ranks);
    MPI_Barrier(comm_);
    log.record(
        [&] { points_.rebalance([&](mpm::Positions, MPI_Comm) { return std::move(parts); }); });
    double cost[] = {call_s, call_s + log.last_s(num_ranks)};
    MPI_Allreduce(MPI_IN_PLACE, cost, 2, MPI_DOUBLE, MPI_MAX, comm_);
    return {cost[0], cost[1]};
}

double CallTurns::middle_of(int window) const {
    return start_of(window) + (plan_.num_turns + 1) * plan_.every / 2.0;
}

RebalanceCost CallTurns::cost(std::size_t method, int step) const {
    int after = 0;
    while (after < plan_.num_windows && middle_of(after) < step) ++after;
    if (after == 0) return median_of(method, 0);
    const RebalanceCost low = median_of(method, after - 1);
    if (after == plan_.num_windows) return low;
    const RebalanceCost high = median_of(method, after);
    const double length = middle_of(after) - middle_of(after - 1);
    const double share = (step - middle_of(after - 1)) / length;
    return {std::lerp(low.call_s, high.call_s, share), std::lerp(low.all_s, high.all_s, share)};
}

RebalanceCost CallTurns::median_of(std::size_t method, int window) const {
    std::vector<double> calls_s;
    std::vector<double> all_s;
    for (const RebalanceCost& cost : callers_[method].costs[static_cast<std::size_t>(window)]) {
        calls_s.push_back(cost.call_s);
        all_s.push_back(cost.all_s);
    }
    return {median(std::move(calls_s)), median(std::move(all_s))};
}

Interval CallTurns::scale95(std::size_t method) const {
    std::vector<double> ratios;
    for (int window = 0; window < plan_.num_windows; ++window) {
        const double middle = median_of(method, window).all_s;
        for (const RebalanceCost& cost : callers_[method].costs[static_cast<std::size_t>(window)]) {
            ratios.push_back(cost.all_s / middle);
        }
    }
    return interval95(std::move(ratios)).value_or(Interval{1, 1});
}

}  // namespace comparisons
