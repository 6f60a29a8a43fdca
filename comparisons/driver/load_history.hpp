#pragma once

#include "controller/rebalance_rule.hpp"

#include <functional>
#include <string>

namespace comparisons {

/// What a run of steps takes, whenever its parts are made anew; loads and costs have one unit.
struct LoadHistory {
    std::string name;
    int num_steps = 0;
    /// Of `step`, where the parts were made before step `made`, at most `step`; those of the start
    /// before step 0.
    std::function<rrcb::StepLoad(int made, int step)> load;
    /// Of a rebalance before `step`.
    std::function<double(int step)> cost;
    bool cost_is_known = true;  ///< of the parts that the run starts with
};

}  // namespace comparisons
