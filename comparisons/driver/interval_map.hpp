#pragma once

#include "load_history.hpp"
#include "row.hpp"
#include "statistics.hpp"

#include <string>
#include <vector>

namespace comparisons {

/// Unbalance that grows by the same amount in every step, and what a rebalance costs; in mean loads
/// of a step.
struct LinearGrowth {
    double cost = 0;    ///< of a rebalance
    double floor = 0;   ///< excess of the heaviest load just after a rebalance
    double growth = 0;  ///< of that excess in a step
};

/// Of rebalances every so many steps, over the ideal time: cost / T + floor + growth (T - 1) / 2.
double predicted_overhead(const LinearGrowth& model, int every);

/// The interval of the least predicted_overhead, sqrt(2 cost / growth) in whole steps; `num_steps`
/// where that is less or nothing grows.
int predicted_interval(const LinearGrowth& model, int num_steps);

/// The mean cost, floor and growth of a history, the growth over the first `stretch` steps of parts
/// that are made at any time; fewer than the history has.
LinearGrowth linear_growth(const LoadHistory& history, int stretch);

/// The same over about as many steps as the interval predicted by it, at most a quarter of all.
LinearGrowth growth_in_a_cycle(const LoadHistory& history);

/// Costs and excess loads of all steps over the mean loads, where rebalanced before the steps 0,
/// every, 2 every, ...
double overhead_of_interval(const LoadHistory& history, int every);

/// The same where the controller says when; before step 0 as well.
double overhead_of_controller(const LoadHistory& history);

/// The same without any rebalance.
double overhead_of_none(const LoadHistory& history);

/// 1, 2, 3, 5, 7, 10, 15, 20, 30, ... up to `num_steps`, and that itself.
std::vector<int> mapped_intervals(int num_steps);

/// The history of one method in one scene.
struct MappedMethod {
    std::string method;
    LoadHistory history;
    Interval cost_scale{1, 1};  ///< 95 % interval of the median cost, over that
    double cost_s = 0;          ///< of a rebalance in the middle of the steps
    double call_s = 0;          ///< of the balancer in it
};

/// A scene on so many ranks.
struct MappedScene {
    std::string scene;
    int num_ranks = 1;
    LoadHistory none;
    std::vector<MappedMethod> methods;
};

/// What one method comes to.
struct Optimum {
    std::string scene;
    int num_ranks = 1;
    std::string method;
    int best_every = 1;  ///< of the mapped intervals
    double overhead = 0;
    Interval
        overhead95{};  ///< of the best interval where the cost is at either end of its interval
    LinearGrowth model{};
    int predicted_every = 1;
    double predicted = 0;  ///< overhead
    double of_controller = 0;
    double cost_s = 0;
    double call_s = 0;
};

/// The optimum of every method.
std::vector<Optimum> optima(const MappedScene& scene);

/// scene,ranks,method,every,overhead: a row without `every` of none, one for each interval of each
/// method, and one with `auto` of the controller.
std::vector<Row> map_rows(const MappedScene& scene);

/// A row for each of the optima.
std::vector<Row> optimum_rows(const MappedScene& scene);

/// scene,ranks,method,every,step,imbalance,rebalanced,lost: a row for each step of none and, under
/// each method, of the best interval and the controller. `rebalanced` is 1 after a rebalance; lost
/// is all excess load so far with the rebalances, in mean loads of a step.
std::vector<Row> step_rows(const MappedScene& scene);

}  // namespace comparisons
