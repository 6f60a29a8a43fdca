#pragma once

#include <rrcb/balance.hpp>

#include <mpi.h>

#include <memory>
#include <optional>

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
///             controller.rebalanced({.cost = seconds, .report = &balance.report});
///         }
///         ...                                              // a step of the simulation
///         controller.step({.load = seconds_of_work, .weight = points.count});
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

    /// Work of one step on this rank.
    struct Step {
        double load = 0;  ///< time of this rank's own work, without waiting for others, in the unit
                          ///< of the costs of rebalances; finite and not negative
        /// Sum of the weights given to balance(), or the number of points if it got no weights. If
        /// it is given, the load is smoothed: it counts as `weight` times the average cost of a
        /// unit of weight on this rank, so that the noise of a clock is not mistaken for imbalance.
        /// Give it with measured loads. If it is the number of points although there are weights,
        /// the load is not smoothed.
        std::optional<double> weight{};
        /// A number of this rank, such as the speed of its fastest point, or null. step() replaces
        /// it by the largest number of any rank in the step before, -infinity if there was none:
        /// the reduction of this step overlaps with what follows. NaN counts as infinity.
        double* largest = nullptr;
    };

    /// Records a step; returns due().
    ///
    ///     if (controller.step({.load = seconds, .weight = weight})) rebalance();  // your function
    ///
    /// Collective, but it waits only for ranks that have not recorded the previous step. If a rank
    /// gave an illegal number or reported another number of rebalances, throws the same Error on
    /// every rank, one call later, and in every later call; then make a new controller. An MPI
    /// error is thrown on the rank on which it occurs. Call it in the same order as other functions
    /// with the communicator of the constructor.
    RRCB_API bool step(const Step& step);

    /// Returns whether to rebalance before the next step, according to the latest step(); false
    /// after rebalanced(). The result is the same on every rank. Not collective.
    RRCB_API bool due() const;

    /// Cost of a rebalance on this rank.
    struct Rebalance {
        double cost = 0;  ///< time including the migration of the points, in the unit of the loads;
                          ///< the largest of all ranks counts
        /// Report of the balance, if there is one. No rebalance is due while heaviest load / mean
        /// load is at most its least_imbalance.
        const Report* report = nullptr;
    };

    /// Records a rebalance since the last step, whether it was due or not. Call it on all ranks; it
    /// does not communicate.
    RRCB_API void rebalanced(const Rebalance& rebalance);

  private:
    friend class experimental::CostModel;
    friend struct detail::Restart;
    struct State;
    explicit Controller(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace rrcb
