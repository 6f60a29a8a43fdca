#pragma once

#include "collective/communicator.hpp"
#include "collective/failure.hpp"
#include "collective/non_stop.hpp"

#include <mpi.h>

namespace rrcb {

/// One rank in a collective call: it takes part to the end, whatever goes wrong on it.
///
/// A failure takes the same way everywhere, so that no rank leaves a call alone:
/// 1. Local steps run in attempt(), messages between two ranks in check(). Both hold back what
///    fails.
/// 2. From then on the rank skips its local steps and sends nothing in place of data, in as many
///    messages.
/// 3. All ranks meet in agree(), which throws the error of the lowest failing rank on all of them.
///
/// Where messages to the root travel anyway, the failure rides on them and saves that reduction:
/// each rank tells its failing_rank(), or that it failed(), with its data. The root hears of it,
/// decides nothing, and tells failing_rank() where its decision was to be. Then all ranks
/// fail_together().
struct Participant {
    MPI_Comm comm;
    Failure failure{};            ///< first one on this rank
    int failing_there = no_rank;  ///< rank of whose failure a message told
    NonStop arithmetic{};

    bool failed() const { return failure.failed; }
    bool can_go_on() const { return !failed() && failing_there == no_rank; }

    /// Runs a step that waits for no other rank, unless a rank is known to have failed.
    template <class Step>
    void attempt(Step&& step) {
        if (can_go_on()) failure = rrcb::attempt(step);
    }

    /// Runs a step that compares what the ranks have: it may fail because another one has failed,
    /// of which agree() then tells in its place.
    template <class Step>
    void compare(Step&& step) {
        if (!can_go_on()) return;
        failure = rrcb::attempt(step);
        failure.may_follow = failure.failed;
    }

    /// Holds back the error of an MPI call, which other ranks waited for whatever failed before.
    void check(int code, const char* call) {
        if (code == MPI_SUCCESS || failed()) return;
        failure = rrcb::attempt([&] { mpi::check(code, call); });
    }

    /// Throws what failed on this rank, of which no other hears.
    void throw_alone() const {
        if (failed()) throw Error(failure.code, failure.text.data());
    }

    /// Notes the failing rank that a message told, which may be no_rank or some_rank.
    void hear_of(int rank) {
        if (failing_there == no_rank) failing_there = rank;
    }

    /// Rank that is known to have failed, this one first; no_rank where none is.
    int failing_rank() const { return failed() ? mpi::rank_of(comm) : failing_there; }
};

}  // namespace rrcb
