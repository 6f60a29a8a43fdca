#include "parallel/communicator_mpi.hpp"

#include <new>
#include <stdexcept>

namespace mpm {

std::string broadcast(std::string text, MPI_Comm comm, int from) {
    auto length = static_cast<int>(text.size());
    MPI_Bcast(&length, 1, MPI_INT, from, comm);
    text.resize(static_cast<std::size_t>(length));
    MPI_Bcast(text.data(), length, MPI_CHAR, from, comm);
    return text;
}

void fail_together(const std::string& text, MPI_Comm comm) {
    int first = text.empty() ? size_of(comm) : rank_of(comm);
    MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm);
    if (first < size_of(comm)) throw std::runtime_error(broadcast(text, comm, first));
}

void together(const std::function<void()>& work, const std::string& place, MPI_Comm comm) {
    std::string text;
    try {
        work();
    } catch (const std::bad_alloc&) {
        text = place + " need more memory than there is; take larger cells or more machines";
    } catch (const std::runtime_error& error) {
        text = error.what();
    }
    fail_together(text, comm);
}

}  // namespace mpm
