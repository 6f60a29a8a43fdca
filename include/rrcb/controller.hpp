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
/// every rank and rests on the loads up to two steps before. Cost: one small reduction a step
/// on a communicator of its own, which overlaps with the next step; only the constructor allocates.
class Controller {
  public:
    /// Makes a communicator of its own. Collective over `comm`, which may be freed before the
    /// controller. Throws Error on every rank for MPI_COMM_NULL and intercommunicators.
    RRCB_API explicit Controller(MPI_Comm comm);

    /// Frees the communicator. Collective, except after MPI_Finalize, which frees it as well.
    RRCB_API ~Controller();
    /// Takes over another controller, which may then only be destroyed or assigned to. Not
    /// collective.
    RRCB_API Controller(Controller&&) noexcept;
    /// Takes over another controller; collective if this one still has a communicator.
    RRCB_API Controller& operator=(Controller&&) noexcept;

    /// Records a step: this rank's own work took `load`, without waiting for others. Returns due().
    ///
    /// Collective, yet it waits only for ranks without a call for the previous step.
    /// `load` is finite and not negative, in the unit of the costs of rebalanced(). Throws Error on
    /// every rank alike, one call later, if a rank gave an illegal number or reported another
    /// number of rebalances. Every later call then throws it, too: make a new controller. An MPI
    /// error is thrown on the rank on which it occurs. Call it in the same order as other functions
    /// with the communicator of the constructor.
    RRCB_API bool step(double load);

    /// Records a step and smooths the load; returns due(). Prefer it for measured loads.
    ///
    ///     if (controller.step(seconds_of_work, sum_of_weights)) rebalance();  // your function
    ///
    /// Collective, and throws, as step(load). The load is taken as `weight` times the average cost
    /// of a unit of it on this rank, so the noise of a clock is not mistaken for imbalance.
    /// @param load   of this rank's own work, finite and not negative, in the unit of the costs
    /// @param weight of this rank's points: the sum of the weights given to balance(); their number
    /// only if it got none. If their number is given nevertheless, `load` is not smoothed
    RRCB_API bool step(double load, double weight);

    /// Returns whether to rebalance before the next step, by the latest step(); false after
    /// rebalanced(). The same on every rank. Not collective.
    RRCB_API bool due() const;

    /// Records a rebalance since the last step, whether due or not. Called on all ranks, without
    /// communication.
    ///
    /// @param report of the balance: no rebalance is due while heaviest load / mean load is at most
    /// its ReportDetails::least_imbalance
    /// @param cost   time of the rebalance on this rank, in the unit of the loads, with the
    /// migration of the points; the largest of all ranks counts
    RRCB_API void rebalanced(const Report& report, double cost);

    /// Records a rebalance by a balancer without a report. On all ranks, without
    /// communication.
    RRCB_API void rebalanced(double cost);

  private:
    friend class experimental::CostModel;
    friend struct detail::Restart;
    struct State;
    explicit Controller(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace rrcb
