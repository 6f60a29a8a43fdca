#pragma once

#include <rrcb/balance.hpp>

#include <mpi.h>

#include <cstdint>
#include <memory>

namespace rrcb {

/// Decides when a rebalance pays, by what steps and rebalances take.
///
///     rrcb::Controller controller(comm);
///     for (std::int64_t step = 0; ...; ++step)
///         if (controller.step(step, load)) {  // seconds of this rank's own work, or its weight
///             ...                             // balance() and transfer()
///             controller.rebalanced(balance.report, seconds);
///         }
///
/// A rebalance is due once a step costs as much beyond its mean load as the steps so far have on
/// average, the rebalances among them; docs/rebalancing.md derives it. Single slow steps and noise
/// do not count, and there is nothing to set. The decision is the same on every rank, two steps
/// after the loads it rests on. Cost: one reduction of 80 bytes a step, during the next one, on a
/// communicator of its own; no call allocates except the constructor.
class Controller {
  public:
    /// Makes a communicator of its own. Collective over `comm`, which may be freed before the
    /// controller. Throws Error on every rank for MPI_COMM_NULL and intercommunicators.
    RRCB_API explicit Controller(MPI_Comm comm);

    /// Frees the communicator. Collective, except after MPI_Finalize, which frees it as well.
    RRCB_API ~Controller();
    /// Takes over; the other may only be destroyed or assigned to. Not collective.
    RRCB_API Controller(Controller&&) noexcept;
    /// Takes over; collective if this one still has a communicator.
    RRCB_API Controller& operator=(Controller&&) noexcept;

    /// Returns whether to rebalance now, after step `number`, which has loaded this rank by `load`.
    ///
    /// Collective, yet it waits only for ranks that have not called it for the step before. All
    /// ranks give one `number`, less than 2^53, and loads in the unit of the costs, finite and not
    /// negative. Throws Error on every rank alike, one call later, if a rank gave another number,
    /// an illegal load or cost, or reported another number of rebalances; from then on each call
    /// throws it, and a new controller is needed. An error of MPI is thrown where it occurs.
    RRCB_API bool step(std::int64_t number, double load);

    /// Records that the ranks have rebalanced since the last step, asked to or not.
    ///
    /// If they were not asked to, one of the next two steps may ask by loads from before it. Called
    /// on all ranks, without communication. `cost` is what it took on this rank with the migration
    /// of the points; the largest of all ranks counts. No rebalance is due while heaviest load /
    /// mean load is at most ReportDetails::least_imbalance of `report`.
    RRCB_API void rebalanced(const Report& report, double cost);

    /// Records a rebalance by a balancer that knows no least imbalance. On all ranks, without
    /// communication.
    RRCB_API void rebalanced(double cost);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rrcb
