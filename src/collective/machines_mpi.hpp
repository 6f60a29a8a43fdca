#pragma once

#include "collective/participant.hpp"

namespace rrcb::mpi {

/// Ranks of each machine of a communicator, if the machines are alike.
struct Machines {
    int num_ranks = 1;   ///< of each, the last may have fewer; 1 also if machines are not alike
    bool dealt = false;  ///< ranks are dealt to the machines in turn; otherwise consecutive ones
};

/// Finds the machines if all have as many ranks, the last perhaps fewer, which are consecutive or
/// dealt in turn.
///
/// Collective over `self.comm`, a duplicate of the library's own, when called for the first time
/// with it: the ranks agree if they have not met, a communicator is made and freed, with a
/// broadcast on it, and a broadcast and a reduction over all ranks. Throws the same Error on every
/// rank if one of them has failed; then nothing is kept.
Machines machines_of(Participant& self);

}  // namespace rrcb::mpi
