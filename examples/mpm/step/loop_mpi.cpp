#include "parallel/communicator_mpi.hpp"
#include "parallel/points.hpp"
#include "step/stepper.hpp"

#include <rrcb/plan.hpp>
#include <rrcb/transfer.hpp>

namespace mpm {

// README.md quotes this function.
template <int D>
std::size_t Stepper<D>::turn(const Balancer* balancer) {
    if (balancer != nullptr) {
        const double start = MPI_Wtime();
        Decomposition next = (*balancer)(positions(), comm_);
        const rrcb::Plan moves = rrcb::plan(owners_by(next), size_of(comm_), comm_);
        rrcb::transfer_in_place(moves, comm_, particles.columns());
        divide_by(std::move(next));
        neighbours_.emplace(boxes_of(decomposition), D, comm_, travel_);
        fit_to_box(moves.import_indices.size());
        controller.rebalanced({.cost = MPI_Wtime() - start});
        return moves.export_indices.size();
    }
    work.restart();
    points_to_nodes();
    work.pause();
    std::span<double> sums = ghosts_->sums_of(patch_);
    neighbours_->sum(ghosts_->shared(), rrcb::column(sums, 1 + 2 * D), patch_.fields);
    work.resume();
    move_nodes();
    nodes_to_points();
    work.pause();
    double speed = fastest();
    if (costs)
        costs->step(work.seconds(), work_columns(), &speed);
    else
        controller.step({.load = work.seconds(), .weight = worked_points, .largest = &speed});
    end_step(speed);
    const std::size_t num_held = particles.size();
    const std::size_t num_new = neighbours_->migrate(points_of(positions()), particles.columns());
    fit_to_points(num_new);
    return num_held + num_new - particles.size();
}

template std::size_t Stepper<2>::turn(const Balancer*);
template std::size_t Stepper<3>::turn(const Balancer*);

}  // namespace mpm
