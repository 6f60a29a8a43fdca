#include "failure_mpi.hpp"

namespace comparisons {

std::string first_message(const std::string& mine, MPI_Comm comm) {
    const int rank = rank_of(comm);
    const int size = size_of(comm);
    int speaker = mine.empty() ? size : rank;
    MPI_Allreduce(MPI_IN_PLACE, &speaker, 1, MPI_INT, MPI_MIN, comm);
    if (speaker == size) return {};
    int length = static_cast<int>(mine.size());
    MPI_Bcast(&length, 1, MPI_INT, speaker, comm);
    std::string message = mine;
    message.resize(static_cast<std::size_t>(length));
    MPI_Bcast(message.data(), length, MPI_CHAR, speaker, comm);
    return message;
}

void fail_together(const std::string& mine, MPI_Comm comm) {
    const std::string message = first_message(mine, comm);
    if (!message.empty()) throw Failure(message);
}

}  // namespace comparisons
