// What tests/clients/real_programs compares between two runs of a client.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

/// The fullest rank over the mean of those that have rows. Collective.
inline double imbalance_of(int num_rows) {
    std::array<int, 2> sums{num_rows, num_rows > 0 ? 1 : 0};
    int most = num_rows;
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return sums[0] == 0 ? 1 : static_cast<double>(most) * sums[1] / sums[0];
}

/// Rank 0 prints.
inline void print_result(int objects, double imbalance, const std::vector<double>& answer) {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank != 0) return;
    std::printf("result objects %d imbalance %.4f answer", objects, imbalance);
    for (const double value : answer) std::printf(" %.12g", value);
    std::printf("\n");
}
