#pragma once

#include "zoltan/handle/state.hpp"

namespace rrcb::zoltan {

/// Gives a new handle those of RRCB's parameters that are in the environment under their names, and
/// IMBALANCE_TOL, which is RRCB_IMBALANCE_TOL there. The program may override them later. If a
/// value is illegal, the default remains and rank 0 warns once. Not collective.
void read_environment(State& state);

}  // namespace rrcb::zoltan
