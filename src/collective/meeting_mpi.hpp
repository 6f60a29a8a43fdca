#pragma once

#include "collective/communicator.hpp"
#include "collective/participant.hpp"

#include <mpi.h>

#include <cstddef>
#include <span>

namespace rrcb {

// Messages of the meeting with which a call begins. Ranks that are in different calls cannot
// receive each other's messages, so that they wait, and the Watch throws an Error on all of them.
// After the meeting the same functions wait without a Watch. Errors of MPI are held back in `self`.

/// Waits under a Watch, which may throw Error; then the request is still pending. Returns MPI's
/// code.
int wait_watched(MPI_Request& request, CallLog& log);

/// Waits for a message between two ranks.
void wait(MPI_Request& request, const char* call, Participant& self);

/// Receives a message from a rank; its length is at most that of `bytes`.
void receive(std::span<std::byte> bytes, int from, mpi::Tag kind, Participant& self);

/// Sends a message to a rank.
void send(std::span<const std::byte> bytes, int to, mpi::Tag kind, Participant& self);

/// Broadcasts from the root, as mpi::broadcast(); ends the meeting. Collective.
void broadcast_and_meet(std::span<std::byte> bytes, Participant& self);

/// Ends the meeting: all ranks are known to be in the call.
void note_met(Participant& self);

}  // namespace rrcb
