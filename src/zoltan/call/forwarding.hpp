#pragma once

#include "zoltan/handle/state.hpp"

namespace rrcb::zoltan {

/// Returns whether Zoltan's RCB is to answer a partitioning call with these parameters.
///
/// RRCB balances one weight and cuts across the axes of the coordinates, between two objects or at
/// one. All ranks decide alike if none of the compared parameters differs between them.
bool forwards(const Parameters& parameters);

/// Prints once in a program, on rank 0, why Zoltan's RCB answers a call of RRCB. Prints nothing
/// at DEBUG_LEVEL 0.
void print_forwarding(const State& state, const char* function) noexcept;

}  // namespace rrcb::zoltan
