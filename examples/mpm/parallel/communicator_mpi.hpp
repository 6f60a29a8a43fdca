#pragma once

#include <mpi.h>

#include <functional>
#include <string>

namespace mpm {

/// Returns the number of this rank in a communicator. Not collective.
inline int rank_of(MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank;
}

/// Returns the number of ranks of a communicator. Not collective.
inline int size_of(MPI_Comm comm) {
    int size = 1;
    MPI_Comm_size(comm, &size);
    return size;
}

/// Returns the text of one rank on every rank. Collective.
std::string broadcast(std::string text, MPI_Comm comm, int from = 0);

/// Throws std::runtime_error on all ranks if any passes a text. The message is the text of the
/// lowest such rank. Collective.
void fail_together(const std::string& text, MPI_Comm comm);

/// Calls `work`, which is not collective. Throws std::runtime_error on all ranks if any rank throws
/// it, or runs out of memory; then the text names `place`. Collective.
void together(const std::function<void()>& work, const std::string& place, MPI_Comm comm);

}  // namespace mpm
