#include "collective/communicator.hpp"

#include <rrcb/error.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace rrcb::mpi {

void check(int code, const char* call) {
    if (code == MPI_SUCCESS) return;
    char text[MPI_MAX_ERROR_STRING] = "";
    int length = 0;
    MPI_Error_string(code, text, &length);
    throw Error(ErrorCode::mpi, std::string(call) + " failed: " + text);
}

int to_int(std::int64_t count) {
    if (count < 0 || count > std::numeric_limits<int>::max())
        throw Error(ErrorCode::mpi, "a message of " + std::to_string(count) +
                                        " items exceeds the range of MPI's counts; use more ranks");
    return static_cast<int>(count);
}

void broadcast(std::span<std::byte> bytes, int root, MPI_Comm comm) {
    while (!bytes.empty()) {
        const std::size_t size = std::min(bytes.size(), longest_message);
        check(MPI_Bcast(bytes.data(), static_cast<int>(size), MPI_BYTE, root, comm), "MPI_Bcast");
        bytes = bytes.subspan(size);
    }
}

int sum_of(int here, MPI_Comm comm) {
    check(MPI_Allreduce(MPI_IN_PLACE, &here, 1, MPI_INT, MPI_SUM, comm), "MPI_Allreduce");
    return here;
}

int rank_of(MPI_Comm comm) {
    int rank = 0;
    check(MPI_Comm_rank(comm, &rank), "MPI_Comm_rank");
    return rank;
}

int size_of(MPI_Comm comm) {
    int size = 0;
    check(MPI_Comm_size(comm, &size), "MPI_Comm_size");
    return size;
}

}  // namespace rrcb::mpi
