#pragma once

#include "collective/participant.hpp"

#include <rrcb/cuts.hpp>

#include <span>

namespace rrcb {

/// Gives every rank of `comm` all cuts. One rank has each cut, the others have zeros. Collective
/// over `comm`; `self` holds errors back.
void join_cuts(std::span<Cut> tree, MPI_Comm comm, Participant& self);

/// Returns all cuts, as the public function, over a duplicated communicator.
Cuts gather_cuts(const Cuts& cuts, Participant& self);

}  // namespace rrcb
