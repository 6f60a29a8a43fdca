#pragma once

#include <rrcb/controller.hpp>

#include <mpi.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rrcb::experimental {

/// Learns what points cost in seconds, for balance() to divide time in place of counts.
///
///     rrcb::Controller controller(comm);
///     rrcb::experimental::CostModel model(controller, 2);
///     for (...) {
///         if (controller.due()) {
///             weights = model.weights(columns_of_points);       // (1, share of a cell) each
///             ...                                               // balance() and transfer()
///             controller.rebalanced(balance.report, seconds);
///         }
///         model.step(seconds_of_work, {{points, cells}});       // after a step of the simulation
///     }
///
/// A column is a number counted on each rank, on which its time may depend. The first is the number
/// of points. docs/weights.md has examples.
class CostModel {
  public:
    /// Makes a model without a controller, on a communicator of its own. Collective.
    ///
    /// @param comm        may be freed before the model
    /// @param num_columns 1 to 16
    /// Throws Error on every rank for other numbers, and as Controller for its communicator.
    RRCB_API CostModel(MPI_Comm comm, int num_columns);

    /// Makes a model whose sums travel with a controller's reduction, before its first step.
    /// Collective. When other weights come into use, the controller expects a gain from a
    /// rebalance.
    ///
    /// @param controller must outlive the model, which calls its step()
    /// @param num_columns 1 to 16
    /// Throws Error on every rank for other numbers, and if the controller has recorded a step or
    /// has a model.
    RRCB_API CostModel(Controller& controller, int num_columns);

    /// Frees the communicator, if the model has one. Collective then, as ~Controller().
    RRCB_API ~CostModel();
    /// Takes over another model, which may then only be destroyed or assigned to. Not collective.
    RRCB_API CostModel(CostModel&&) noexcept;
    /// Takes over another model; collective if this one still has a communicator.
    RRCB_API CostModel& operator=(CostModel&&) noexcept;

    /// Records a step. Collective, yet it waits only for ranks without a call for the previous
    /// step. With a controller, its due() returns whether to rebalance.
    ///
    /// @param seconds of this rank's own work; processor time if ranks share cores
    /// @param columns this rank's number of each column, from 0 to 1e100
    /// Throws Error on every rank alike, one call later, if a rank gave another number, or too many
    /// or few. Every later call then throws it. Cost: a small reduction, which overlaps with
    /// the next step, and a fit on rank 0; no allocation.
    RRCB_API void step(double seconds, std::span<const double> columns);

    /// Returns the seconds of a unit of each column, by the steps so far, in which late ones count
    /// more; 0 for a column without a cost. Not collective; the same bits on every rank.
    RRCB_API std::vector<double> costs() const;

    /// Returns whether weights() uses the costs. The same on every rank. Not collective.
    RRCB_API bool uses_costs() const;

    /// Returns the weight in seconds of each point, to divide the points by at once.
    ///
    /// `columns` has a row for each point of this rank: its share of each column. The rows add up
    /// to the columns of step(). For instance, each of 4 points in a cell has a quarter of
    /// the cell. A column of no point, such as ghosts, is 0 in each row. While
    /// counting is better, each point weighs 1. Called on all ranks, without communication. Throws
    /// Error on this rank if the last row is not complete.
    RRCB_API std::vector<double> weights(std::span<const double> columns);

    /// Returns a sentence: whether costs are used, and why. The same on every rank. Not collective.
    RRCB_API std::string report() const;

  private:
    friend std::vector<std::byte> save(const CostModel& model);
    friend CostModel load_cost_model(std::span<const std::byte> bytes, MPI_Comm comm);
    friend CostModel load_cost_model(std::span<const std::byte> bytes, Controller& controller);
    struct State;
    explicit CostModel(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// Returns the state of a cost model as bytes, the same on every rank; save its controller too.
/// Collective as save() of a controller. At most 1 kB for 5 columns on 8 ranks.
RRCB_API std::vector<std::byte> save(const CostModel& model);

/// Restores a model, on a communicator of its own. Collective.
///
/// On as many ranks as before it goes on with the same bits. On another number it keeps its costs
/// and its judgement, as its report() says.
/// @param bytes of save(), the same on every rank, in either byte order
/// @param comm  as for the constructor
/// Throws Error as load() of a controller.
[[nodiscard]] RRCB_API CostModel load_cost_model(std::span<const std::byte> bytes, MPI_Comm comm);

/// Restores a model that was made with a controller, before the next step of that. Collective.
///
/// @param bytes      as above
/// @param controller loaded before; must outlive the model
[[nodiscard]] RRCB_API CostModel load_cost_model(std::span<const std::byte> bytes,
                                                 Controller& controller);

}  // namespace rrcb::experimental
