#pragma once

#include "controller/load_window.hpp"
#include "controller/waste_history.hpp"

#include <array>
#include <cstddef>

namespace rrcb {

/// What one step took on the ranks.
struct StepLoad {
    double mean = 0;
    double heaviest = 0;
};

/// Says when a rebalance pays, from what the steps and the rebalances took; docs/rebalancing.md
/// derives it. Nothing here communicates or allocates.
///
/// Loads and costs have one unit, whichever it is. Excess is heaviest / mean - 1, waste the sum of
/// excess times mean, and a cycle the steps from one rebalance to the next.
class RebalanceRule {
  public:
    /// Takes the next step; one without load says nothing.
    void add(const StepLoad& load);

    /// The steps from here on are those after a rebalance of this cost, which leaves an imbalance
    /// (heaviest / mean) of `least_imbalance` at least.
    void rebalanced(double cost, double least_imbalance);

    /// Whether a rebalance before the next step is expected to pay.
    bool is_due() const;

    /// The next rebalance may leave less excess than the earlier ones, as the weights have changed.
    void expect_less() {
        expects_less_ = true;
        patience_ = 1;
    }

  private:
    /// Sums over the cycles before this one, each counted half as much as the next.
    struct Past {
        double cycles = 0;
        double work = 0;
        double waste = 0;
    };

    double cost() const;
    double mean_cost() const;
    double floor() const;
    double lasting_excess() const;
    void end_cycle();

    double unit_ = 0;  ///< the first mean load: sums of loads in it overflow nowhere
    LoadWindow window_;
    WasteHistory history_;
    std::array<double, 3> costs_{};   ///< the latest, in turns
    std::array<double, 4> floors_{};  ///< lowest excess after the latest rebalances, in turns
    bool expects_less_ = false;       ///< what the rebalances left says nothing of the next one
    std::size_t num_rebalances_ = 0;
    double least_ = 0;  ///< excess that no rebalance removes
    Past past_;
    double left_ = 0;      ///< lasting excess when this cycle began
    double patience_ = 1;  ///< waste to put up with, in rebalances
};

}  // namespace rrcb
