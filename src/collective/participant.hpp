#pragma once

#include "arithmetic/non_stop.hpp"
#include "collective/call_log.hpp"
#include "collective/communicator.hpp"
#include "collective/failure.hpp"

#include <mpi.h>

#include <memory>

namespace rrcb {

/// One rank in a collective call: it takes part to the end, even if it fails.
///
/// All failures are handled alike, so that no rank leaves a call alone:
/// 1. Local steps run in attempt(), messages between two ranks in check(). Both hold failures back.
/// 2. From then on the rank skips its local steps, and sends as many messages, without data.
/// 3. All ranks meet in agree(), which throws the error of the lowest failing rank on all of them.
///
/// The first messages of a call, its meeting, reach no rank in another call. Ranks that wait for
/// them watch for that, see mpi::Watch: broadcast, agree() or a butterfly end the meeting.
///
/// Messages to the root can carry the failure and save that reduction: each rank sends its
/// failing_rank(), or failed(), with its data. The root then decides nothing, and sends
/// failing_rank() in place of its decision. Then all ranks fail_together().
struct Participant {
    MPI_Comm comm;
    std::shared_ptr<CallLog> log{};  ///< null if no ranks may differ in their calls
    Failure failure{};               ///< first one on this rank
    int failing_there = no_rank;     ///< failing rank that a message named
    NonStop arithmetic{};

    /// Returns true until this rank knows that all ranks are in the same call.
    bool is_meeting() const { return log && log->is_meeting; }

    /// Returns the tag of messages between two ranks, which during the meeting contains the call.
    int tag(mpi::Tag kind) const { return is_meeting() ? log->tag(kind) : kind; }

    /// Returns CallLog::group, 0 if it is not known.
    std::uint64_t group() const { return log ? log->group : 0; }

    bool failed() const { return failure.failed; }
    bool can_go_on() const { return !failed() && failing_there == no_rank; }

    /// Runs a step that waits for no other rank, unless a rank is known to have failed.
    template <class Step>
    void attempt(Step&& step) {
        if (can_go_on()) failure = rrcb::attempt(step);
    }

    /// Runs a step that compares data of the ranks. It may fail because another rank has failed;
    /// agree() then reports the failure of that rank instead.
    template <class Step>
    void compare(Step&& step) {
        if (!can_go_on()) return;
        failure = rrcb::attempt(step);
        failure.may_follow = failure.failed;
    }

    /// Holds back the error of an MPI call that other ranks wait for, whatever failed before.
    void check(int code, const char* call) {
        if (code == MPI_SUCCESS || failed()) return;
        failure = rrcb::attempt([&] { mpi::check(code, call); });
    }

    /// Throws the failure of this rank, on this rank only: of a message after which no other one
    /// follows that could carry it.
    void throw_alone() const {
        if (failed()) throw Error(failure.code, failure.text.data());
    }

    /// Throws the failure of a last message, on this rank only. Without memory for a last message,
    /// which has no records, the result is complete.
    void throw_failed_message() const {
        if (failed() && failure.code == ErrorCode::mpi) throw_alone();
    }

    /// Notes the failing rank that a message named, which may be no_rank or some_rank.
    void hear_of(int rank) {
        if (failing_there == no_rank) failing_there = rank;
    }

    /// Returns a rank that is known to have failed, this one first; no_rank if there is none.
    int failing_rank() const { return failed() ? mpi::rank_of(comm) : failing_there; }
};

}  // namespace rrcb
