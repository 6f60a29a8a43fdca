// Rank 0 holds 300 points in a row; every part must get 100 of them.
#include <rrcb/rrcb.hpp>

#include <mpi.h>

#include <cstdio>
#include <vector>

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);

    std::vector<double> x;
    for (int i = 0; rank == 0 && i < 300; ++i) x.push_back(i);
    const rrcb::Points points(x, 1);
    const rrcb::Balance balance = rrcb::balance(points, MPI_COMM_WORLD);
    const std::vector<double> weights = rrcb::part_weights(points, balance, MPI_COMM_WORLD);

    const bool even = weights == std::vector<double>{100, 100, 100};
    if (rank == 0)
        std::printf("rrcb %s: parts of 100 points: %s\n", rrcb::version(), even ? "yes" : "no");
    MPI_Finalize();
    return even ? 0 : 1;
}
