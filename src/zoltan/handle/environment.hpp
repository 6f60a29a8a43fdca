#pragma once

#include "zoltan/handle/state.hpp"

namespace rrcb::zoltan {

/// Gives a new handle the parameters of RRCB's own that are in the environment under their names,
/// and IMBALANCE_TOL, which is there as RRCB_IMBALANCE_TOL. What the program sets comes later, and
/// so wins. An illegal value leaves the default; rank 0 warns of it once. Not collective.
void read_environment(State& state);

}  // namespace rrcb::zoltan
