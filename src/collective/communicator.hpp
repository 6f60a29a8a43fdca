#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace rrcb::mpi {

/// Kind of a message between two ranks, on the duplicate of a communicator.
///
/// A rank may already be in the next call, so the tag distinguishes kinds. Within a kind, a call
/// receives every message that is sent to it and names the sender, so that MPI's order of messages
/// is enough.
///
/// In the meeting at the beginning of a call, tags also contain the call; see CallLog::tag().
enum Tag : int {
    contribution_tag = 1,
    points_tag,
    exchange_tag,
    stream_tag,
    butterfly_tag,
    agreement_tag,
    report_tag,
    verdict_tag,
    printed_tag,
    notice_tag,
    neighbour_tag
};

/// Throws Error with the text of an MPI error code that is not MPI_SUCCESS.
void check(int code, const char* call);

/// Narrows a count to MPI's int; throws Error if it does not fit.
int to_int(std::int64_t count);

/// Maximum number of bytes in a message. Tests lower it.
inline std::size_t longest_message = std::numeric_limits<int>::max();

/// Broadcasts as MPI_Bcast, but any number of bytes, which is the same on each rank. Collective
/// over `comm`.
void broadcast(std::span<std::byte> bytes, int root, MPI_Comm comm);

/// Returns the sum over all ranks. Collective.
int sum_of(int here, MPI_Comm comm);

int rank_of(MPI_Comm comm);
int size_of(MPI_Comm comm);

}  // namespace rrcb::mpi
