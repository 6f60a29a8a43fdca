#include "parallel/communicator_mpi.hpp"

#include <stdexcept>

namespace mpm {

std::string broadcast(std::string text, MPI_Comm comm) {
    auto length = static_cast<int>(text.size());
    MPI_Bcast(&length, 1, MPI_INT, 0, comm);
    text.resize(static_cast<std::size_t>(length));
    MPI_Bcast(text.data(), length, MPI_CHAR, 0, comm);
    return text;
}

void fail_together(const std::string& text, MPI_Comm comm) {
    const std::string of_all = broadcast(text, comm);
    if (!of_all.empty()) throw std::runtime_error(of_all);
}

}  // namespace mpm
