#include "failure_mpi.hpp"

#include <exception>

namespace comparisons {

std::string first_message(const std::string& mine, MPI_Comm comm) {
    int speaker = mine.empty() ? size_of(comm) : rank_of(comm);
    MPI_Allreduce(MPI_IN_PLACE, &speaker, 1, MPI_INT, MPI_MIN, comm);
    return speaker == size_of(comm) ? "" : mpm::broadcast(mine, comm, speaker);
}

void on_root(const std::function<void()>& step, MPI_Comm comm) {
    std::string message;
    try {
        if (rank_of(comm) == 0) step();
    } catch (const std::exception& error) {
        message = error.what();
    }
    message = mpm::broadcast(message, comm);
    if (!message.empty()) throw Failure(message);
}

}  // namespace comparisons
