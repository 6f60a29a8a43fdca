#include "collective/spread_failure_mpi.hpp"

#include "collective/communicator.hpp"
#include "collective/merge_tree.hpp"

#include <rrcb/error.hpp>

#include <algorithm>
#include <thread>

namespace rrcb::mpi {

namespace {

/// Sends the notice of a failure without waiting for its delivery. The memory of the notice belongs
/// to the log, which outlives the message.
void send_notice(CallLog& log, int to, int tag) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Isend(&log.notice, sizeof log.notice, MPI_BYTE, to, tag, log.comm, &request);
    if (request != MPI_REQUEST_NULL) MPI_Request_free(&request);
}

/// Returns true if no message of this rank to a neighbour is pending.
bool are_delivered(const CallLog& log) {
    for (LinkMessages* out = log.undelivered.get(); out != nullptr; out = out->next.get()) {
        int is_done = 0;
        MPI_Testall(static_cast<int>(out->requests.size()), out->requests.data(), &is_done,
                    MPI_STATUSES_IGNORE);
        if (is_done == 0) return false;
    }
    return true;
}

/// Receives all messages that have arrived. If there is no memory for one, it is received without
/// its contents.
void receive_all(MPI_Comm comm, detail::Uninitialized<std::byte>& memory) {
    for (int is_there = 1; is_there != 0;) {
        MPI_Message message = MPI_MESSAGE_NULL;
        MPI_Status status{};
        MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, comm, &is_there, &message, &status);
        if (is_there == 0) return;
        int bytes = 0;
        MPI_Get_count(&status, MPI_BYTE, &bytes);
        if (attempt([&] { memory.resize(static_cast<std::size_t>(bytes)); }).failed) bytes = 0;
        MPI_Mrecv(memory.data(), bytes, MPI_BYTE, &message, MPI_STATUS_IGNORE);
    }
}

}  // namespace

void spread(const Failure& failure, CallLog& log) {
    log.end = CallLog::End::failed;
    log.is_meeting = false;
    log.notice = failure;
    for (const NeighbourLink* link : log.links)
        for (std::size_t n = 0; n < link->ranks.size(); ++n)
            if (link->is_over[n] == 0) send_notice(log, link->ranks[n], neighbour_tag);
    keep_undelivered(log);
    const int rank = rank_of(log.comm);
    const MergeTree tree{size_of(log.comm)};
    tree.for_each_child(rank, [&](int child) { send_notice(log, child, notice_tag); });
    if (rank != 0) send_notice(log, tree.parent(rank), notice_tag);
    attempt([&] { log.why = failure.text.data(); });
    throw Error(failure.code, failure.text.data());
}

void look_for_failure(CallLog& log) {
    int is_there = 0;
    MPI_Status status{};
    MPI_Iprobe(MPI_ANY_SOURCE, notice_tag, log.comm, &is_there, &status);
    if (is_there == 0) return;
    FailureNotice notice;
    MPI_Recv(&notice, sizeof notice, MPI_BYTE, status.MPI_SOURCE, notice_tag, log.comm,
             MPI_STATUS_IGNORE);
    spread(notice, log);
}

void keep_undelivered(CallLog& log) {
    for (NeighbourLink* link : log.links) {
        if (link->outgoing->next || link->outgoing == log.undelivered) continue;
        link->outgoing->next = std::exchange(log.undelivered, link->outgoing);
    }
    log.links.clear();
}

void drain(CallLog& old, MPI_Comm comm) {
    detail::Uninitialized<std::byte> memory;
    MPI_Request barrier = MPI_REQUEST_NULL;
    bool has_begun = false;
    for (int is_done = 0; is_done == 0; std::this_thread::yield()) {
        receive_all(old.comm, memory);
        if (!has_begun && are_delivered(old)) {
            has_begun = true;
            check(MPI_Ibarrier(comm, &barrier), "MPI_Ibarrier");
        }
        if (has_begun) check(MPI_Test(&barrier, &is_done, MPI_STATUS_IGNORE), "MPI_Test");
    }
    old.undelivered.reset();
}

}  // namespace rrcb::mpi
