#pragma once

#include "collective/participant.hpp"

namespace rrcb::mpi {

/// Returns the ranks of a machine if every machine has as many consecutive ones, the last perhaps
/// fewer; otherwise 1.
///
/// Collective over `self.comm`, a duplicate of the library's own, when called for the first time
/// with it: a communicator is made and freed, with a broadcast on it, and a broadcast and a
/// reduction over all ranks. Throws the same Error on every rank if one of them has failed; then
/// nothing is kept.
int ranks_per_machine(Participant& self);

}  // namespace rrcb::mpi
