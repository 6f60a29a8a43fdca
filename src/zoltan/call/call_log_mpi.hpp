#pragma once

#include "zoltan/call/partition_mpi.hpp"

namespace rrcb::zoltan {

/// Logs a call that RRCB has answered, on stdout.
///
/// Rank 0 prints one line for the first call of the process, if RRCB_VERBOSE is in the environment
/// or DEBUG_LEVEL is at least 1. With RRCB_VERBOSE it also prints the sum of all calls at exit.
///
/// Either all ranks or none must call it. Collective with RRCB_VERBOSE: one reduction.
void log_call(const State& state, const Partition& result, double seconds) noexcept;

/// Returns whether RRCB has answered a call in this process.
bool any_call_answered() noexcept;

}  // namespace rrcb::zoltan
