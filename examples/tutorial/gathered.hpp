// Gathers copies of the particles of all ranks, which steps 2 and 3 of the tutorial need.
#pragma once

#include <mpi.h>

#include <vector>

inline std::vector<double> gathered(const std::vector<double>& own, MPI_Comm comm) {
    int num_ranks = 1;
    MPI_Comm_size(comm, &num_ranks);
    const int count = static_cast<int>(own.size());
    std::vector<int> counts(static_cast<std::size_t>(num_ranks));
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
    std::vector<int> offsets{0};
    for (const int each : counts) offsets.push_back(offsets.back() + each);
    std::vector<double> all(static_cast<std::size_t>(offsets.back()));
    MPI_Allgatherv(own.data(), count, MPI_DOUBLE, all.data(), counts.data(), offsets.data(),
                   MPI_DOUBLE, comm);
    return all;
}
