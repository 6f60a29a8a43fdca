// The shortest loop of a particle code: its seconds decide when the particles are divided anew.
#include "particles.hpp"

#include <rrcb/rrcb.hpp>

#include <mpi.h>

#include <cstdio>
#include <vector>

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    const MPI_Comm comm = MPI_COMM_WORLD;
    int rank = 0;
    int num_ranks = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &num_ranks);
    std::vector<double> positions = strip_of(rank, num_ranks);
    double pairs = 0;
    {
        rrcb::Controller controller(comm);
        rrcb::Balance balance;
        for (int step = 0; step < 100; ++step) {
            const rrcb::Points points = rrcb::interleaved_points(positions, 2);
            const double start = MPI_Wtime();
            const bool is_due = step == 0 || controller.due();
            if (is_due)
                balance = rrcb::balance(points, {}, balance.cuts, comm);
            else
                balance.parts = rrcb::assign_all(balance.cuts, points, comm);
            const rrcb::Plan plan = rrcb::plan(balance, comm);
            positions = rrcb::transfer(plan, rrcb::column(positions, 2), comm);
            if (is_due) controller.rebalanced(balance.report, MPI_Wtime() - start);

            const rrcb::Points mine = rrcb::interleaved_points(positions, 2);
            const rrcb::GhostPlan near = rrcb::ghosts(balance.cuts, mine, {.radius = radius}, comm);
            const std::vector<double> ghosts = rrcb::fetch(near, rrcb::column(positions, 2), comm);

            const double began = MPI_Wtime();
            pairs += sum_of(count_neighbours(positions, ghosts));  // your step
            move(positions);
            const double seconds = MPI_Wtime() - began;
            const double count = static_cast<double>(mine.count);
            controller.step(seconds, count);
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &pairs, 1, MPI_DOUBLE, MPI_SUM, comm);
    if (rank == 0) std::printf("%.0f pairs of neighbours met in 100 steps\n", pairs);
    MPI_Finalize();
}

// Output on 4 ranks:
// 66744352 pairs of neighbours met in 100 steps
