#include "collective/watch_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/spread_failure_mpi.hpp"

#include <rrcb/error.hpp>

#include <cmath>
#include <type_traits>
#include <utility>

namespace rrcb::mpi {

namespace {

static_assert(std::is_trivially_copyable_v<CallRecord> &&
              std::is_trivially_copyable_v<CallDifference>);

/// Sends a message that may never be received; its memory must stay.
template <class Message>
void leave(const Message& message, int to, Tag tag, MPI_Comm comm) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Isend(&message, sizeof message, MPI_BYTE, to, tag, comm, &request);
    if (request != MPI_REQUEST_NULL) MPI_Request_free(&request);
}

/// Receives a message if one is there; returns its rank, or no_rank.
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

std::chrono::duration<double> agree_limit() {
    static const double seconds = agree_seconds().value_or(0);
    return std::chrono::duration<double>(std::isnan(seconds) ? 0 : seconds);
}

std::string text_of_absence(const Deadline& deadline, CallName call) {
    return "no call of " + std::string(name_of(call)) + " on ranks " + deadline.absent() +
           " within " + std::to_string(std::lround(deadline.limit().count())) +
           " s (RRCB_AGREE_SECONDS); every rank must make the same calls in the same order";
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

void throw_end(const std::string& why) {
    throw Error(ErrorCode::mpi, why);
}

// Neighbours may be some calls apart, so that the roll call of such calls is one for all.
Watch::Watch(CallLog& log, Scope scope)
    : log_(log),
      scope_(scope),
      deadline_(log.comm, scope == Scope::all ? log.tag(roll_call_tag) : roll_call_tag,
                agree_limit(), true) {}

void Watch::look() {
    const auto waited = deadline_.waited();
    // Until then MPI gives up the processor as its user wants.
    if (waited < short_wait) return;
    // The communicator of the calls was freed: only a controller goes on without it.
    if (log_.comm == MPI_COMM_NULL) return pause(waited);
    if (scope_ == Scope::all) look_for_failure(log_);
    if (waited >= patience) compare();
    if (deadline_.is_missed())
        end(CallLog::End::missing, text_of_absence(deadline_, log_.mine.latest()) +
                                       "; this communicator cannot be used further");
    pause(waited);
}

void Watch::compare() {
    if (rank_of(log_.comm) != root) {
        if (!std::exchange(has_reported_, true)) {
            log_.sent = log_.mine;
            leave(log_.sent, root, report_tag, log_.comm);
        }
        if (take(log_.verdict, root, verdict_tag, log_.comm) == no_rank) return;
        end(CallLog::End::differed, text_of(log_.verdict));
    }
    const Failure lacks_memory = attempt([&] { take_reports(log_); });
    if (lacks_memory.failed || log_.known.empty()) return;
    log_.known[root] = log_.mine;
    const auto difference = find_different_calls(log_.known);
    if (!difference) return;
    log_.verdict = *difference;
    for (int rank = root + 1; rank < size_of(log_.comm); ++rank)
        leave(log_.verdict, rank, verdict_tag, log_.comm);
    end(CallLog::End::differed, text_of(log_.verdict));
}

void Watch::end(CallLog::End how, std::string&& why) {
    log_.end = how;
    log_.is_meeting = false;
    log_.why = std::move(why);
    throw_end(log_.why);
}

}  // namespace rrcb::mpi
