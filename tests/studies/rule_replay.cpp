// The controller's rule without MPI, for studies in Python: the loads of all ranks in, steps out.
#include "controller/point_cost.hpp"
#include "controller/rebalance_rule.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

struct rule_replay {
    rrcb::RebalanceRule rule{};
    std::vector<rrcb::PointCost> costs{};  ///< of each rank
    int steps_to_go = 0;                   ///< until a decision reaches the ranks; 0: there is none
};

namespace {

rrcb::StepLoad load_of(const double* loads, const double* points, rule_replay& replay) {
    double work = 0;
    double sum = 0;
    double heaviest = 0;
    const auto size = static_cast<double>(replay.costs.size());
    for (std::size_t rank = 0; rank < replay.costs.size(); ++rank) {
        const double load =
            points ? replay.costs[rank].smoothed(loads[rank], points[rank]) : loads[rank];
        work += loads[rank];
        sum += load;
        heaviest = std::max(heaviest, load);
    }
    return rrcb::smoothed_load(work / size, sum / size, heaviest);
}

}  // namespace

extern "C" {

rule_replay* rule_replay_create(int num_ranks) {
    auto replay = std::make_unique<rule_replay>();
    replay->costs.resize(static_cast<std::size_t>(num_ranks));
    return replay.release();
}

void rule_replay_free(rule_replay* replay) {
    delete replay;
}

void rule_replay_rebalanced(rule_replay* replay, double cost) {
    replay->rule.rebalanced(cost, 1);
}

/// Takes steps until the ranks learn that a rebalance is due, and returns how many; 0 if none is
/// due after `num_steps`. Loads and points, which may be null, of each rank step by step.
int rule_replay_run(rule_replay* replay, const double* loads, const double* points, int num_steps) {
    constexpr int lag = 2;
    const std::size_t num_ranks = replay->costs.size();
    for (int step = 1; step <= num_steps; ++step) {
        replay->rule.add(load_of(loads, points, *replay));
        loads += num_ranks;
        if (points) points += num_ranks;
        if (replay->steps_to_go > 0) {
            if (--replay->steps_to_go == 0) return step;
        } else if (replay->rule.is_due()) {
            replay->steps_to_go = lag;
        }
    }
    return 0;
}
}
