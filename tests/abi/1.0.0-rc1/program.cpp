// Balances points that are unevenly distributed over the ranks, moves them, and fetches copies of
// the points near each rank's box. The calls need only arrays and a communicator.
#include <rrcb/rrcb.hpp>

#include <mpi.h>

#include <cstdio>
#include <vector>

// Returns the points of this rank. Unit squares of 40 x 40 points form a row; rank r has r + 1 of
// them, which follow those of rank r - 1.
std::vector<double> squares_of(int rank) {
    const int first = rank * (rank + 1) / 2;
    std::vector<double> coordinates;
    for (int i = 0; i < 40 * (rank + 1); ++i) {
        for (int j = 0; j < 40; ++j) {
            coordinates.push_back(first + (i + 0.5) / 40);
            coordinates.push_back((j + 0.5) / 40);
        }
    }
    return coordinates;
}

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const std::vector<double> coordinates = squares_of(rank);

    const rrcb::Points points(coordinates, 2);
    const rrcb::Balance balance = rrcb::balance(points, MPI_COMM_WORLD);
    const rrcb::Plan plan = rrcb::plan(balance, MPI_COMM_WORLD);

    // Columns of the points in this rank's box, and copies of others within 0.05 of it.
    const std::vector<double> here =
        rrcb::transfer(plan, rrcb::column(coordinates, 2), MPI_COMM_WORLD);
    const rrcb::GhostPlan near =
        rrcb::ghost_plan(balance.cuts, rrcb::Points(here, 2), MPI_COMM_WORLD, {.cutoff = 0.05});
    const std::vector<double> ghosts = rrcb::fetch(near, rrcb::column(here, 2), MPI_COMM_WORLD);

    const double moved = rrcb::moved_fraction(points, balance, MPI_COMM_WORLD);
    if (rank == 0) {
        std::printf("%lld points in %d parts\n",
                    static_cast<long long>(balance.report.details.num_points),
                    balance.cuts.num_parts);
        std::printf("imbalance %.4f, moved %.0f %%\n", balance.report.imbalance, 100 * moved);
        std::printf("rank 0 sends %zu points and receives %zu\n", plan.export_indices.size(),
                    plan.import_indices.size());
        std::printf("it has %zu, and copies of %zu near its box\n", here.size() / 2,
                    ghosts.size() / 2);
    }
    MPI_Finalize();
}

// Output on 4 ranks:
// 16000 points in 4 parts
// imbalance 1.0000, moved 50 %
// rank 0 sends 0 points and receives 2400
// it has 4000, and copies of 80 near its box
