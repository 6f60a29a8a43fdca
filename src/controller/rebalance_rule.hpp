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

/// Returns the load of a step: the mean is the measured one, `work`, and its excess is that of the
/// smoothed loads `mean` and `heaviest`.
StepLoad smoothed_load(double work, double mean, double heaviest);

/// Decides when a rebalance pays, from the loads of the steps and the costs of the rebalances;
/// docs/design/rebalancing.md explains the rule. Does not communicate or allocate.
///
/// Loads and costs may have any common unit. The excess of a step is (heaviest / mean) - 1, waste
/// is the sum of excess times mean, and a cycle consists of the steps from one rebalance to the
/// next.
class RebalanceRule {
  public:
    /// Adds the next step. A step without load is ignored.
    void add(const StepLoad& load);

    /// Starts a cycle after a rebalance of this cost. The rebalance cannot reduce the imbalance
    /// (heaviest / mean) below `least_imbalance`.
    void rebalanced(double cost, double least_imbalance);

    /// Returns whether a rebalance before the next step is expected to pay.
    bool is_due() const;

    /// Forgets the course of earlier cycles, so that the next rebalance is expected to leave no
    /// excess.
    void expect_less();

    void store(auto& state) {
        state.each(unit_, latest_, cycle_, earlier_, knows_rebalances_, busiest_, slow_start_,
                   costs_, num_rebalances_, least_);
    }

  private:
    /// What a rebalance before the next step is measured against.
    struct Prospect {
        double mean;          ///< mean work of a step of this cycle, in units
        double cost;          ///< expected cost of the rebalance, in units
        double least_excess;  ///< least excess after any rebalance so far
    };
    bool pays(double excess, double lasted, const Prospect& next) const;
    double cost() const;
    double slow_start() const;

    double unit_ = 0;  ///< the first mean load; other loads are divided by it, so that sums do not
                       ///< overflow
    LatestSteps latest_;
    Cycle cycle_;
    Cycle earlier_;                  ///< average of all earlier cycles
    bool knows_rebalances_ = false;  ///< whether earlier_ shows the excess that a rebalance leaves
    double busiest_ = 0;     ///< largest work of four consecutive steps in this cycle, not counting
                             ///< the first four
    double slow_start_ = 0;  ///< slow_start() of the last cycle
    std::array<double, 3> costs_{};  ///< costs of the last three rebalances, in a ring
    std::size_t num_rebalances_ = 0;
    double least_ = 0;  ///< excess that even a perfect rebalance leaves
};

}  // namespace rrcb
