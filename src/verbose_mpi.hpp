#pragma once

#include "collective/participant.hpp"

#include <rrcb/balance.hpp>

namespace rrcb {

/// Returns whether RRCB_VERBOSE is in the environment of this process, and not 0.
bool is_verbosity_asked();

/// Prints a line about a balance begun at `start` by MPI_Wtime(), on rank 0 of the
/// communicator if is_verbosity_asked() there. Not collective.
void print_line(const Balance& made, const Options& options, double start, const Participant& self);

}  // namespace rrcb
