#pragma once

#include "collective/call_log.hpp"

#include <mpi.h>

namespace rrcb::mpi {

// A failure in a call that waits only for neighbours cannot reach all ranks by a reduction. The
// rank that fails sends a notice to its neighbours, and to its own in a tree of all ranks. Ranks
// that wait for it find the notice: neighbours in the same call or the next, others in the next
// meeting. So each rank throws and sends its own notices. Then all make another duplicate.

/// Ends the use of the duplicate, sends the notices, and throws the failure. Not collective.
[[noreturn]] void spread(const Failure& failure, CallLog& log);

/// Throws the failure of a rank next to this one in the tree, if there is one. Not collective.
void look_for_failure(CallLog& log);

/// Keeps the messages of all links that may never be received. Never throws.
void keep_undelivered(CallLog& log);

/// Receives the messages to this rank that nobody waits for, until all ranks have done so, after
/// which nobody needs their memory. Collective over `comm`, of the same ranks, after all ranks have
/// ended the use of the old duplicate.
void drain(CallLog& old, MPI_Comm comm);

}  // namespace rrcb::mpi
