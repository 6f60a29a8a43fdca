#pragma once

#include "collective/communicator.hpp"
#include "collective/participant.hpp"

#include <mpi.h>

#include <cstddef>
#include <span>

namespace rrcb {

// These functions send the messages of the meeting with which a call begins. Ranks in different
// calls cannot receive each other's messages; they wait, and the Watch throws an Error on all of
// them. After the meeting the same functions wait without a Watch. Errors of MPI are held back in
// `self`.

/// Waits under a Watch. If the Watch throws Error, the request is still pending. Returns MPI's
/// code.
int wait_watched(MPI_Request& request, CallLog& log);

/// Waits for a message between two ranks.
void wait(MPI_Request& request, const char* call, Participant& self);

/// Receives a message from a rank. The message is at most as long as `bytes`.
void receive(std::span<std::byte> bytes, int from, mpi::Tag kind, Participant& self);

/// Sends a message to a rank.
void send(std::span<const std::byte> bytes, int to, mpi::Tag kind, Participant& self);

/// Broadcasts from the root, as mpi::broadcast(); ends the meeting. Collective.
void broadcast_and_meet(std::span<std::byte> bytes, Participant& self);

/// Ends the meeting, when it is known that all ranks are in the call.
void note_met(Participant& self);

}  // namespace rrcb
