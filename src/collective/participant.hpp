#pragma once

#include "arithmetic/non_stop.hpp"
#include "collective/call_log.hpp"
#include "collective/communicator.hpp"
#include "collective/failure.hpp"

#include <mpi.h>

#include <memory>

namespace rrcb {

/// One rank in a collective call. It takes part to the end, even if it fails.
///
/// All failures are handled in the same way, so that no rank leaves a call alone:
/// 1. Local steps run in attempt(), messages between two ranks in check(). Both hold failures back.
/// 2. After a failure the rank skips its local steps. It sends all its messages, but without data.
/// 3. All ranks meet in agree(), which throws the error of the lowest failing rank on every rank.
///
/// The first messages of a call, its meeting, cannot be received by a rank in another call. Ranks
/// that wait for them detect that case; see mpi::Watch. A broadcast, agree() or a butterfly ends
/// the meeting.
///
/// Messages to the root can carry the failure and so save that reduction: each rank sends
/// failing_rank() or failed() with its data. After a failure the root sends failing_rank() in place
/// of its decision, and all ranks call fail_together().
struct Participant {
    MPI_Comm comm;
    std::shared_ptr<CallLog> log{};  ///< null if all ranks certainly make the same call
    Failure failure{};               ///< the first failure on this rank
    int failing_there = no_rank;     ///< failing rank that a message has named
    NonStop arithmetic{};

    /// Returns true until this rank has evidence that all ranks are in the same call.
    bool is_meeting() const { return log && log->is_meeting; }

    /// Returns the tag of a message between two ranks. During the meeting it contains the call.
    int tag(mpi::Tag kind) const { return is_meeting() ? log->tag(kind) : kind; }

    /// Returns CallLog::group, or 0 if it is not known.
    std::uint64_t group() const { return log ? log->group : 0; }

    bool failed() const { return failure.failed; }
    bool can_go_on() const { return !failed() && failing_there == no_rank; }

    /// Runs a step that does not wait for another rank. Skips it if a rank is known to have failed.
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

    /// Checks an MPI call for which other ranks wait, so that it is made even after a failure.
    /// Holds its error back.
    void check(int code, const char* call) {
        if (code == MPI_SUCCESS || failed()) return;
        failure = rrcb::attempt([&] { mpi::check(code, call); });
    }

    /// Throws the failure of this rank on this rank only. Needed after the last message of a call,
    /// when no other message can carry the failure.
    void throw_alone() const {
        if (failed()) throw Error(failure.code, failure.text.data());
    }

    /// Throws the failure of a last message, on this rank only. Ignores a lack of memory: the last
    /// message has no records, so the result is complete.
    void throw_failed_message() const {
        if (failed() && failure.code == ErrorCode::mpi) throw_alone();
    }

    /// Notes the failing rank that a message has named; it may be no_rank or some_rank.
    void hear_of(int rank) {
        if (failing_there == no_rank) failing_there = rank;
    }

    /// Returns a rank that is known to have failed, preferably this one; no_rank if there is none.
    int failing_rank() const { return failed() ? mpi::rank_of(comm) : failing_there; }
};

}  // namespace rrcb
