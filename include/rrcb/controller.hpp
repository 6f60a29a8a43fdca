#pragma once

#include <rrcb/balance.hpp>

#include <mpi.h>

#include <memory>

namespace rrcb {

namespace detail {
struct Restart;
}  // namespace detail
namespace experimental {
class CostModel;
}  // namespace experimental

/// Decides when a rebalance pays, from the time of the steps and of the rebalances.
///
///     rrcb::Controller controller(comm);
///     for (...) {
///         if (controller.due()) {
///             ...                                          // balance() and transfer()
///             controller.rebalanced(balance.report, seconds);
///         }
///         ...                                              // a step of the simulation
///         controller.step(seconds_of_work, points.count);
///     }
///
/// docs/design/rebalancing.md explains the rule, which has no settings. The decision is the same on
/// every rank, and depends on loads up to two steps before. Cost: a small reduction in each step on
/// its own communicator, which overlaps with the next step; only the constructor allocates memory.
class Controller {
  public:
    /// Makes a communicator of its own. Collective over `comm`, which may be freed before the
    /// controller. Throws Error on every rank for MPI_COMM_NULL and intercommunicators.
    RRCB_API explicit Controller(MPI_Comm comm);

    /// Frees the communicator. Collective, except after MPI_Finalize, when it has been freed
    /// already.
    RRCB_API ~Controller();
    /// Takes over the state of another controller, which may then only be destroyed or assigned to.
    /// Not collective.
    RRCB_API Controller(Controller&&) noexcept;
    /// Takes over the state of another controller. Collective if this one still has a communicator.
    RRCB_API Controller& operator=(Controller&&) noexcept;

    /// Records a step in which this rank's own work took `load`, without waiting for others.
    /// Returns due().
    ///
    /// Collective, but it waits only for ranks that have not recorded the previous step. `load`
    /// must be finite and not negative, in the unit of the costs of rebalanced(). If a rank gave an
    /// illegal number or reported another number of rebalances, throws the same Error on every
    /// rank, one call later, and in every later call; then make a new controller. An MPI error is
    /// thrown on the rank on which it occurs. Call it in the same order as other functions with the
    /// communicator of the constructor.
    RRCB_API bool step(double load);

    /// Records a step and smooths the load; returns due(). Prefer it for measured loads.
    ///
    ///     if (controller.step(seconds_of_work, sum_of_weights)) rebalance();  // your function
    ///
    /// Collective, and throws, as step(load). The smoothed load is `weight` times the average cost
    /// of a unit of weight on this rank, so that the noise of a clock is not mistaken for
    /// imbalance.
    /// @param load   of this rank's own work, finite and not negative, in the unit of the costs
    /// @param weight of this rank's points: the sum of the weights given to balance(), or their
    /// number if it got no weights. If the number is given although there are weights, `load` is
    /// not smoothed
    RRCB_API bool step(double load, double weight);

    /// Returns whether to rebalance before the next step, according to the latest step(); false
    /// after rebalanced(). The result is the same on every rank. Not collective.
    RRCB_API bool due() const;

    /// Records a rebalance since the last step, whether it was due or not. Call it on all ranks; it
    /// does not communicate.
    ///
    /// @param report of the balance: no rebalance is due while heaviest load / mean load is at most
    /// its ReportDetails::least_imbalance
    /// @param cost   time of the rebalance on this rank, including the migration of the points, in
    /// the unit of the loads; the largest of all ranks counts
    RRCB_API void rebalanced(const Report& report, double cost);

    /// Records a rebalance by a balancer without a report. Call it on all ranks; it does not
    /// communicate.
    RRCB_API void rebalanced(double cost);

  private:
    friend class experimental::CostModel;
    friend struct detail::Restart;
    struct State;
    explicit Controller(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace rrcb
