#pragma once

#include <rrcb/controller.hpp>

#include <mpi.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rrcb::experimental {

/// Learns how many seconds points cost, so that balance() can divide time.
///
///     rrcb::Controller controller(comm);
///     rrcb::experimental::CostModel model(controller, 2);
///     for (...) {
///         if (controller.due()) {
///             weights = model.weights(columns_of_points);       // (1, share of a cell) each
///             ...                                               // balance() and transfer()
///             controller.rebalanced({.cost = seconds, .report = &balance.report});
///         }
///         model.step(seconds_of_work, {{points, cells}});       // after a step of the simulation
///     }
///
/// A column is a number that each rank counts, and on which its time may depend. The first column
/// is the number of points. docs/weights.md has examples.
class CostModel {
  public:
    /// Makes a model without a controller, on a communicator of its own. Collective.
    ///
    /// @param comm        may be freed before the model
    /// @param num_columns 1 to 16
    /// Throws Error on every rank for other numbers of columns, and for `comm` as Controller.
    RRCB_API CostModel(MPI_Comm comm, int num_columns);

    /// Makes a model whose sums are sent with a controller's reduction. The controller must not
    /// have recorded a step. When other weights come into use, the controller expects a gain from a
    /// rebalance. Collective.
    ///
    /// @param controller  must outlive the model, which calls its step()
    /// @param num_columns 1 to 16
    /// Throws Error on every rank for other numbers of columns, and if the controller has recorded
    /// a step or has a model already.
    RRCB_API CostModel(Controller& controller, int num_columns);

    /// Frees the communicator, if the model has one. In this case collective as ~Controller().
    RRCB_API ~CostModel();
    /// Takes over the state of another model, which may then only be destroyed or assigned to. Not
    /// collective.
    RRCB_API CostModel(CostModel&&) noexcept;
    /// Takes over the state of another model. Collective if this one still has a communicator.
    RRCB_API CostModel& operator=(CostModel&&) noexcept;

    /// Records a step. Collective, but it waits only for ranks that have not recorded the previous
    /// step. If the model has a controller, the controller's due() returns whether to rebalance.
    ///
    /// @param seconds of this rank's own work; use processor time if ranks share cores
    /// @param columns this rank's number for each column, from 0 to 1e100
    /// @param largest as Controller::Step::largest
    /// If a rank gave other numbers, too many or too few, throws the same Error on every rank, one
    /// call later, and in every later call. Cost: a small reduction, which overlaps with the next
    /// step, and a fit on rank 0; no memory is allocated.
    RRCB_API void step(double seconds, std::span<const double> columns, double* largest = nullptr);

    /// Returns the seconds that one unit of each column costs, learned from the steps so far; later
    /// steps count more. A column without a cost has 0. Not collective; bit-identical on every
    /// rank.
    RRCB_API std::vector<double> costs() const;

    /// Returns whether weights() uses the costs. The result is the same on every rank. Not
    /// collective.
    RRCB_API bool uses_costs() const;

    /// Returns the weight in seconds of each point. Divide the points by these weights at once.
    ///
    /// `columns` has a row for each point of this rank: its share of each column, so that the rows
    /// add up to the columns of step(). For example, each of 4 points in a cell has a quarter of
    /// the cell. A column that belongs to no point, such as the number of ghosts, is 0 in each row.
    /// As long as counting is better, each point weighs 1. Call it on all ranks; it does not
    /// communicate. Throws Error on this rank if the last row is not complete.
    RRCB_API std::vector<double> weights(std::span<const double> columns);

    /// Returns a sentence that explains whether costs are used, and why. It is the same on every
    /// rank. Not collective.
    RRCB_API std::string report() const;

  private:
    friend std::vector<std::byte> save(const CostModel& model);
    friend CostModel load_cost_model(std::span<const std::byte> bytes, MPI_Comm comm);
    friend CostModel load_cost_model(std::span<const std::byte> bytes, Controller& controller);
    struct State;
    explicit CostModel(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// Returns the state of a cost model as bytes, which are the same on every rank. Save its
/// controller too. Collective as save() of a controller. For 5 columns on 8 ranks it has at most 1
/// kB.
RRCB_API std::vector<std::byte> save(const CostModel& model);

/// Restores a model, on a communicator of its own. Collective.
///
/// On the same number of ranks, it continues with bit-identical results. On another number it keeps
/// its costs and its judgement, and its report() says so.
/// @param bytes from save(), the same on every rank, in either byte order
/// @param comm  as for the constructor
/// Throws Error as load() of a controller.
[[nodiscard]] RRCB_API CostModel load_cost_model(std::span<const std::byte> bytes, MPI_Comm comm);

/// Restores a model that was made with a controller. Call it before the next step of the
/// controller. Collective.
///
/// @param bytes      as above
/// @param controller must have been loaded before, and must outlive the model
[[nodiscard]] RRCB_API CostModel load_cost_model(std::span<const std::byte> bytes,
                                                 Controller& controller);

}  // namespace rrcb::experimental
