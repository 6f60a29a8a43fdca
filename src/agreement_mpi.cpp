#include "agreement_mpi.hpp"

#include "mpi/communicator.hpp"

#include <array>
#include <string>

namespace rrcb {

namespace {

/// The lowest failing rank, else what is wrong with the ranks together, as the root's failure.
Verdict judge(std::span<const Header> headers, Failure& failure) {
    for (std::size_t rank = 0; rank < headers.size(); ++rank)
        if (headers[rank].failed != 0)
            return {static_cast<std::int32_t>(rank), headers[rank].failed - 1};
    failure = attempt([&] {
        if (const auto difference = difference_between(headers))
            throw Error(ErrorCode::invalid_argument, *difference);
        std::int64_t length = 0;
        for (const Header& header : headers) length += header.num_records * header.record_length;
        mpi::to_int(length);
    });
    return failure.failed ? Verdict{root, static_cast<std::int32_t>(failure.code)} : Verdict{};
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
    Verdict verdict = mpi::rank_of(comm) == root ? judge(headers, failure) : Verdict{};
    mpi::check(MPI_Bcast(&verdict, sizeof verdict, MPI_BYTE, root, comm), "MPI_Bcast");
    if (verdict.failing_rank >= 0) fail_together(verdict, failure, comm);
}

void fail_together(const Verdict& verdict, const Failure& failure, MPI_Comm comm) {
    std::array<char, 512> text{};
    failure.text.copy(text.data(), text.size() - 1);
    mpi::check(
        MPI_Bcast(text.data(), static_cast<int>(text.size()), MPI_CHAR, verdict.failing_rank, comm),
        "MPI_Bcast");
    throw Error(static_cast<ErrorCode>(verdict.code),
                "rank " + std::to_string(verdict.failing_rank) + ": " + text.data());
}

}  // namespace rrcb
