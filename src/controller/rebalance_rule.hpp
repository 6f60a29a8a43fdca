#pragma once

#include "controller/cycle.hpp"

#include <array>
#include <cstddef>

namespace rrcb {

/// Load of one step on the ranks.
struct StepLoad {
    double mean = 0;
    double heaviest = 0;
};

/// Returns the load of a step of `work`, the measured mean, with the excess of smoothed loads.
StepLoad smoothed_load(double work, double mean, double heaviest);

/// Decides when a rebalance pays, from the loads of the steps and the costs of the rebalances;
/// docs/design/rebalancing.md explains it. Does not communicate or allocate.
///
/// Loads and costs have any unit in common. Excess is heaviest / mean - 1, waste the sum of excess
/// times mean, and a cycle the steps from one rebalance to the next.
class RebalanceRule {
  public:
    /// Takes the next step; one without load is ignored.
    void add(const StepLoad& load);

    /// Starts a cycle after a rebalance of this cost, which leaves an imbalance (heaviest / mean)
    /// of `least_imbalance` at least.
    void rebalanced(double cost, double least_imbalance);

    /// Returns whether a rebalance before the next step is expected to pay.
    bool is_due() const;

    /// Forgets the course of earlier cycles: the next rebalance is expected to leave no excess.
    void expect_less();

    void store(auto& state) {
        state.each(unit_, latest_, cycle_, earlier_, knows_rebalances_, busiest_, slow_start_,
                   costs_, num_rebalances_, least_);
    }

  private:
    /// What a rebalance before the next step has to be worth.
    struct Prospect {
        double mean;          ///< work of a step of this cycle, in units, as the cost
        double cost;          ///< of the rebalance
        double least_excess;  ///< of any cycle
    };
    bool pays(double excess, double lasted, const Prospect& next) const;
    double cost() const;
    double slow_start() const;

    double unit_ = 0;  ///< the first mean load, so that sums do not overflow
    LatestSteps latest_;
    Cycle cycle_;
    Cycle earlier_;                  ///< average of the cycles before this one
    bool knows_rebalances_ = false;  ///< the cycle shows the excess that a rebalance leaves
    double busiest_ = 0;             ///< most work of 4 steps in this cycle, after the first
    double slow_start_ = 0;  ///< work of the first steps of the last cycle, see slow_start()
    std::array<double, 3> costs_{};  ///< the last three, cyclic
    std::size_t num_rebalances_ = 0;
    double least_ = 0;  ///< excess left by every rebalance
};

}  // namespace rrcb
