#pragma once

#include "collective/participant.hpp"

#include <rrcb/cuts.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Gives every rank of `comm` all cuts; at the call one rank has each cut, the others zeros.
/// Collective over `comm`; `self` holds errors back.
void join_cuts(std::span<Cut> tree, MPI_Comm comm, Participant& self);

/// As the public function, over a duplicated communicator. An earlier failure on one rank is thrown
/// on all.
Cuts gather_cuts(const Cuts& cuts, Participant& self);

}  // namespace rrcb
