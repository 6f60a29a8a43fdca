#include "agreement_mpi.hpp"

#include "mpi/communicator.hpp"

#include <cmath>
#include <new>
#include <string>

namespace rrcb {

namespace {

/// The lowest failing rank, else the root when the ranks do not fit together; none when all is
/// well.
int judge(std::span<const Header> headers, Failure& failure) {
    for (std::size_t rank = 0; rank < headers.size(); ++rank)
        if (headers[rank].failed != 0) return static_cast<int>(rank);
    failure = attempt([&] {
        if (const auto difference = difference_between(headers))
            throw Error(ErrorCode::invalid_argument, *difference);
        double weight = 0;
        for (const Header& header : headers) weight += header.weight;
        if (std::isinf(weight))
            throw Error(ErrorCode::invalid_argument,
                        "the sum of the weights of all ranks overflows; scale them down");
        std::int64_t length = 0;
        for (const Header& header : headers) length += header.num_records * header.record_length;
        mpi::to_int(length);
    });
    return failure.failed ? root : no_rank;
}

}  // namespace

std::vector<Header> gather_headers(const Header& mine, MPI_Comm comm) {
    const bool is_root = mpi::rank_of(comm) == root;
    std::vector<Header> headers(is_root ? static_cast<std::size_t>(mpi::size_of(comm)) : 0);
    mpi::check(MPI_Gather(&mine, sizeof(Header), MPI_BYTE, headers.data(), sizeof(Header), MPI_BYTE,
                          root, comm),
               "MPI_Gather");
    return headers;
}

void agree(std::span<const Header> headers, Failure& failure, MPI_Comm comm) {
    int failing_rank = mpi::rank_of(comm) == root ? judge(headers, failure) : no_rank;
    mpi::check(MPI_Bcast(&failing_rank, 1, MPI_INT, root, comm), "MPI_Bcast");
    if (failing_rank != no_rank) fail_together(failing_rank, failure, comm);
}

void agree(const Failure& failure, MPI_Comm comm) {
    const int num_ranks = mpi::size_of(comm);
    int failing_rank = failure.failed ? mpi::rank_of(comm) : num_ranks;
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, &failing_rank, 1, MPI_INT, MPI_MIN, comm),
               "MPI_Allreduce");
    if (failing_rank < num_ranks) fail_together(failing_rank, failure, comm);
}

void fail_together(int failing_rank, const Failure& failure, MPI_Comm comm) {
    Failure theirs = failure;
    mpi::check(MPI_Bcast(&theirs, sizeof theirs, MPI_BYTE, failing_rank, comm), "MPI_Bcast");
    try {
        throw Error(theirs.code,
                    "rank " + std::to_string(failing_rank) + ": " + theirs.text.data());
    } catch (const std::bad_alloc&) {
        throw Error(theirs.code);
    }
}

}  // namespace rrcb
