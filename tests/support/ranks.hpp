#pragma once

#include <mpi.h>

namespace rrcb::test {

inline int rank() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

inline int num_ranks() {
    int size = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return size;
}

inline bool is_last_rank() {
    return rank() == num_ranks() - 1;
}

/// Largest value of all ranks. Collective.
inline int largest(int value) {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return value;
}

/// Collective.
inline bool same_on_all_ranks(double value) {
    double ends[] = {value, -value};
    MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return ends[0] == -ends[1];
}

}  // namespace rrcb::test

namespace rrcb {
using test::is_last_rank;
using test::num_ranks;
using test::rank;
}  // namespace rrcb
