#pragma once

#include "collective/participant.hpp"

#include <rrcb/cuts.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Gives every rank of `comm` all cuts. One rank has each cut, the others have zeros. Collective
/// over `comm`; `self` holds errors back.
void join_cuts(std::span<Cut> tree, MPI_Comm comm, Participant& self);

/// Returns all cuts, as the public function, over a duplicated communicator.
Cuts gather_cuts(const Cuts& cuts, Participant& self);

/// Does the same as the public function, over a duplicated communicator. An earlier failure is
/// thrown on all ranks as well.
std::vector<Part> assign_all(const Cuts& cuts, const Points& points, Participant& self);

}  // namespace rrcb
