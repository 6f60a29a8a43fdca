#pragma once

#include "collective/call_log.hpp"

#include <mpi.h>

namespace rrcb::mpi {

// A failure in a call that waits only for neighbours cannot reach all ranks by a reduction.
// Instead, the failing rank sends a notice to its neighbours, and to its parent and children in a
// tree of all ranks. Neighbours find the notice in the same call or the next, other ranks in the
// next meeting. Each rank that finds it sends it on in the same way and throws. In the next call
// all ranks make another duplicate.

/// Ends the use of the duplicate, sends the notices, and throws the failure. Not collective.
[[noreturn]] void spread(const Failure& failure, CallLog& log);

/// If a parent or child in the tree has sent the notice of a failure, sends it on and throws it.
/// Not collective.
void look_for_failure(CallLog& log);

/// Keeps the messages of all exchanges with neighbours, because they may never be received. Never
/// throws.
void keep_undelivered(CallLog& log);

/// Receives the messages to this rank for which no call waits any more, until all ranks have done
/// so and the messages' memory can be freed. Collective over `comm`, another duplicate with the
/// same ranks, after all ranks have ended the use of the old one.
void drain(CallLog& old, MPI_Comm comm);

}  // namespace rrcb::mpi
