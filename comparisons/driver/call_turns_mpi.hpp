#pragma once

#include "method.hpp"
#include "moving_points_mpi.hpp"
#include "statistics.hpp"

#include <mpi.h>

#include <span>
#include <vector>

namespace comparisons {

/// Seconds of a rebalance on the slowest rank, by PhaseLog.
struct RebalanceCost {
    double call_s = 0;  ///< the balancer
    double all_s = 0;   ///< with the migration of the points and what else their owner does
};

/// What rebalances take under several methods, in turns while the points move. One part per rank.
///
/// Time has windows, in each of which turns are some steps apart. In a turn the points go back to
/// the parts that a method made in the turn before, move a step, and the method rebalances them;
/// then those of the next method do.
class CallTurns {
  public:
    struct Plan {
        int num_windows = 5;
        int num_turns = 6;
        int every = 10;  ///< steps from one turn to the next; more than methods
    };

    /// The points must outlive it, whose windows are spread over their steps.
    CallTurns(MovingPoints& points, std::span<const Method> methods, const Plan& plan,
              MPI_Comm comm);

    /// Takes the turn of this step if it has one. Collective. Throws what the balancers throw.
    void act_before(int step);

    /// Linear between the medians of the windows beside the step.
    RebalanceCost cost(std::size_t method, int step) const;

    /// 95 % interval of the median cost, over that; each call by the median of its window.
    Interval scale95(std::size_t method) const;

  private:
    struct Caller {
        mpm::Balancer balancer;
        mpm::Decomposition made;                        ///< in the latest turn
        std::vector<std::vector<RebalanceCost>> costs;  ///< of each window
    };

    int start_of(int window) const;
    double middle_of(int window) const;
    void give_back(const Caller& caller);
    RebalanceCost timed_rebalance(const mpm::Balancer& balancer);
    RebalanceCost median_of(std::size_t method, int window) const;

    MovingPoints& points_;
    Plan plan_;
    MPI_Comm comm_;
    std::vector<Caller> callers_;
};

}  // namespace comparisons
