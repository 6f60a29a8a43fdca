#pragma once

#include "zoltan/handle/state.hpp"

namespace rrcb::zoltan {

/// Gives a new handle the parameters of RRCB that the environment has under their names, and
/// IMBALANCE_TOL, as RRCB_IMBALANCE_TOL there. The program sets its own later, which override them.
/// An illegal value leaves the default; rank 0 warns of it once. Not collective.
void read_environment(State& state);

}  // namespace rrcb::zoltan
