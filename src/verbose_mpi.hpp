#pragma once

#include "collective/participant.hpp"

#include <rrcb/balance.hpp>

#include <vector>

namespace rrcb {

/// Returns whether RRCB_VERBOSE is in the environment of this process, and not 0.
bool is_verbosity_asked();

/// Balances from `previous`, unless it is empty. Prints a line on rank 0 of the communicator if
/// is_verbosity_asked() there. Collective as balance().
Balance balance_aloud(const Points& points, const Options& options, const Cuts& previous,
                      Participant& self, std::vector<Part> memory);

}  // namespace rrcb
