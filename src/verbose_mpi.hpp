#pragma once

#include "collective/participant.hpp"

#include <rrcb/balance.hpp>

namespace rrcb {

/// Returns true if RRCB_VERBOSE is set in the environment of this process, and is not 0.
bool is_verbosity_asked();

/// Prints a line about a balance that began at `start`, a time of MPI_Wtime(). Prints only on rank
/// 0 of the communicator, and only if is_verbosity_asked() there. Not collective.
void print_line(const Balance& made, const Options& options, double start, const Participant& self);

}  // namespace rrcb
