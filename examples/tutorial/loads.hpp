// Measurements of all parallel steps of the tutorial: pairs, and how evenly the ranks count them.
#pragma once

#include <mpi.h>

#include <cstdio>

struct Loads {
    double pairs = 0;     // sum over all ranks and steps
    double heaviest = 0;  // pairs on the busiest rank, summed over the steps

    void add(double own, MPI_Comm comm) {
        double sum = own;
        double most = own;
        MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, comm);
        MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, comm);
        pairs += sum;
        heaviest += most;
    }
    // The imbalance is the work of the busiest rank over the mean.
    void print(MPI_Comm comm) const {
        int rank = 0;
        int num_ranks = 1;
        MPI_Comm_rank(comm, &rank);
        MPI_Comm_size(comm, &num_ranks);
        if (rank > 0) return;
        std::printf("%.0f pairs\n", pairs);
        std::printf("imbalance %.2f\n", heaviest * num_ranks / pairs);
    }
};
