#include "collective/watch_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/spread_failure_mpi.hpp"

#include <rrcb/error.hpp>

#include <thread>
#include <type_traits>
#include <utility>

namespace rrcb::mpi {

namespace {

static_assert(std::is_trivially_copyable_v<CallRecord> &&
              std::is_trivially_copyable_v<CallDifference>);

/// Sends a message that may never be received. Its memory must therefore not be freed.
template <class Message>
void leave(const Message& message, int to, Tag tag, MPI_Comm comm) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Isend(&message, sizeof message, MPI_BYTE, to, tag, comm, &request);
    if (request != MPI_REQUEST_NULL) MPI_Request_free(&request);
}

/// Receives a message if one has arrived. Returns its source, or no_rank.
template <class Message>
int take(Message& message, int from, Tag tag, MPI_Comm comm) {
    int is_there = 0;
    MPI_Status status{};
    MPI_Iprobe(from, tag, comm, &is_there, &status);
    if (is_there == 0) return no_rank;
    MPI_Recv(&message, sizeof message, MPI_BYTE, status.MPI_SOURCE, tag, comm, MPI_STATUS_IGNORE);
    return status.MPI_SOURCE;
}

}  // namespace

void pause(std::chrono::duration<double> waited) {
    if (waited < short_wait) {
        std::this_thread::yield();
    } else {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
}

void take_reports(CallLog& log) {
    if (rank_of(log.comm) != root) return;
    CallRecord report;
    for (int from = 0; from != no_rank;) {
        from = take(report, MPI_ANY_SOURCE, report_tag, log.comm);
        if (from == no_rank) break;
        if (log.known.empty()) log.known.resize(static_cast<std::size_t>(size_of(log.comm)));
        log.known[static_cast<std::size_t>(from)] = report;
    }
}

void Watch::look() {
    const std::chrono::duration<double> waited = Clock::now() - start_;
    // In a short wait MPI's own setting decides whether the rank gives up the processor.
    if (waited < short_wait) return;
    // If the communicator of the calls was freed, only a controller can still be waiting.
    if (log_.comm == MPI_COMM_NULL) return pause(waited);
    if (scope_ == Scope::all) look_for_failure(log_);
    if (waited >= patience) compare();
    pause(waited);
}

void Watch::compare() {
    if (rank_of(log_.comm) != root) {
        if (!std::exchange(has_reported_, true)) {
            log_.sent = log_.mine;
            leave(log_.sent, root, report_tag, log_.comm);
        }
        if (take(log_.verdict, root, verdict_tag, log_.comm) == no_rank) return;
        end();
    }
    const Failure lacks_memory = attempt([&] { take_reports(log_); });
    if (lacks_memory.failed || log_.known.empty()) return;
    log_.known[root] = log_.mine;
    const auto difference = find_different_calls(log_.known);
    if (!difference) return;
    log_.verdict = *difference;
    for (int rank = root + 1; rank < size_of(log_.comm); ++rank)
        leave(log_.verdict, rank, verdict_tag, log_.comm);
    end();
}

void Watch::end() {
    log_.end = CallLog::End::differed;
    log_.is_meeting = false;
    log_.why = text_of(log_.verdict);
    throw Error(ErrorCode::mpi, log_.why);
}

}  // namespace rrcb::mpi
