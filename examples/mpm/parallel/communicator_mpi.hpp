#pragma once

#include <mpi.h>

#include <functional>
#include <string>

namespace mpm {

/// Number of this rank in a communicator. Not collective.
inline int rank_of(MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank;
}

/// Number of ranks of a communicator. Not collective.
inline int size_of(MPI_Comm comm) {
    int size = 1;
    MPI_Comm_size(comm, &size);
    return size;
}

/// Returns the text of one rank on every rank. Collective.
std::string broadcast(std::string text, MPI_Comm comm, int from = 0);

/// Throws std::runtime_error on all ranks if any has a text, with that of the lowest. Collective.
void fail_together(const std::string& text, MPI_Comm comm);

/// Runs work of this rank. Collective; throws std::runtime_error with the place on all ranks if any
/// lacks the memory.
void in_memory(const std::function<void()>& work, const std::string& place, MPI_Comm comm);

}  // namespace mpm
