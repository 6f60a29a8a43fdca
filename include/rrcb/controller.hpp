#pragma once

#include <rrcb/balance.hpp>

#include <mpi.h>

#include <cstdint>
#include <memory>

namespace rrcb {

/// Says when a rebalance pays, from what steps and rebalances take.
///
///     rrcb::Controller controller(comm);
///     for (std::int64_t step = 0; ...; ++step) {
///         const double load = ...;  // seconds of this rank's own work, or its weight
///         if (controller.step(step, load)) {
///             const rrcb::Balance balance = rrcb::balance(points, options, comm);
///             // ... points migrate
///             controller.rebalanced(balance.report, seconds);
///         }
///     }
///
/// A rebalance is due once a step costs as much beyond its mean load as the steps so far have on
/// average, the rebalances among them; docs/rebalancing.md derives it. Single slow steps and noise
/// do not count. There is nothing to set.
///
/// The loads of a step are reduced while the next one runs. The root decides by them, and its
/// decision travels with the next reduction: it is the same on every rank whatever these round,
/// two steps after the loads it rests on. One reduction of 80 bytes a step, on a communicator of
/// its own; no call allocates but the constructor.
class Controller {
  public:
    /// Collective over `comm`, which may be freed before the controller. Throws Error on every
    /// rank for MPI_COMM_NULL and intercommunicators.
    RRCB_API explicit Controller(MPI_Comm comm);

    /// Collective. After MPI_Finalize, which does it as well, nothing is left to do.
    RRCB_API ~Controller();
    /// Takes over; the other may only be destroyed or assigned to. Not collective.
    RRCB_API Controller(Controller&&) noexcept;
    /// The same; collective where this one still had a communicator.
    RRCB_API Controller& operator=(Controller&&) noexcept;

    /// Whether to rebalance now, after step `number`, which has loaded this rank by `load`.
    ///
    /// Collective, yet it waits only for ranks that have not called it for the step before. All
    /// ranks give one `number`, less than 2^53, and loads in the unit of the costs, finite and not
    /// negative. Throws Error on every rank alike, at the call after, where one gave another
    /// number, such a load or cost, or reported another number of rebalances; from then on each
    /// call throws it, and a new controller is needed. An error of MPI is thrown where it occurs.
    RRCB_API bool step(std::int64_t number, double load);

    /// Says that the ranks have rebalanced since the last step, asked to or not.
    ///
    /// Where they were not asked to, one of the next two steps may ask by loads from before it.
    /// On all ranks, without communication. `cost` is what it took on this rank with the migration
    /// of the points; the largest of all ranks counts. Of `report` the least imbalance does: where
    /// the heaviest load is no more above the mean than that, no rebalance is due.
    RRCB_API void rebalanced(const Report& report, double cost);

    /// The same for balancers that know no least imbalance.
    RRCB_API void rebalanced(double cost);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rrcb
