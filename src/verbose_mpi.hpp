#pragma once

#include "collective/communicator.hpp"
#include "collective/participant.hpp"

#include <rrcb/balance.hpp>

#include <mpi.h>

namespace rrcb {

/// Returns whether RRCB_VERBOSE is in the environment of this process, and not 0.
bool is_verbosity_asked();

/// Prints a line about a balance that took this long.
void print_line(const Balance& made, double seconds);

/// Returns what `make` returns, a balance. Prints a line on rank 0 of the communicator if
/// is_verbosity_asked() there. Collective as `make`.
template <class Make>
Balance aloud(const Participant& self, Make&& make) {
    const bool prints = is_verbosity_asked() && mpi::rank_of(self.comm) == 0;
    const double start = prints ? MPI_Wtime() : 0;
    Balance made = make();
    if (prints) print_line(made, MPI_Wtime() - start);
    return made;
}

}  // namespace rrcb
