#pragma once

#include "load_history.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace comparisons {

/// When to rebalance, in a run that goes on step by step.
class Policy {
  public:
    virtual ~Policy() = default;
    /// The first steps of a run are those after a rebalance of this cost.
    virtual void rebalanced(double cost) = 0;
    /// Takes `load` of a step; whether to rebalance before the next one.
    virtual bool step(const rrcb::StepLoad& load) = 0;
};

/// A policy by name, made anew for each run.
struct NamedPolicy {
    std::string name;
    std::function<std::unique_ptr<Policy>()> make;
};

/// The controller's rule, what it is compared with, fixed intervals among it.
std::vector<NamedPolicy> policies();

/// Rebalances before the steps interval, 2 interval, ...
std::unique_ptr<Policy> interval_policy(int interval);

/// The controller's rule, heeded two steps late as on ranks.
std::unique_ptr<Policy> controller_policy();

/// The heaviest loads of all steps and the rebalances.
double cost_of(const LoadHistory& history, Policy& policy);

/// That of the interval_policy.
double cost_of_interval(const LoadHistory& history, int interval);

/// The least of cost_of_interval.
double cost_of_best_interval(const LoadHistory& history);

/// The least of all choices of steps to rebalance before, by dynamic programming.
double optimum(const LoadHistory& history);

}  // namespace comparisons
