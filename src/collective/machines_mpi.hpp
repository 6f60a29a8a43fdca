#pragma once

#include "collective/participant.hpp"

namespace rrcb::mpi {

/// Number of ranks on each machine of a communicator, if the machines are alike.
struct Machines {
    int num_ranks = 1;   ///< of each machine; the last may have fewer. 1 if machines are not alike
    bool dealt = false;  ///< whether ranks are dealt to the machines in turn; otherwise a machine
                         ///< has consecutive ranks
};

/// Finds the machines. They are alike if all have the same number of ranks, except that the last
/// may have fewer, and these ranks are consecutive or dealt in turn.
///
/// The first call with `self.comm`, a duplicate of the library, is collective: the ranks agree if
/// they have not met, a communicator is made, used and freed, and a broadcast and a reduction over
/// all ranks follow. If a rank has failed, throws the same Error on every rank; nothing is kept
/// then.
Machines machines_of(Participant& self);

}  // namespace rrcb::mpi
