#pragma once

#include "collective/participant.hpp"

#include <rrcb/cuts.hpp>

#include <span>

namespace rrcb {

/// Gives every rank of `comm` all cuts, each of which one rank has and the others hold as zeros.
/// Collective over `comm`; `self` holds errors back.
void join_cuts(std::span<Cut> tree, MPI_Comm comm, Participant& self);

/// The whole tree, as the public function, over a communicator that is a duplicate already.
Cuts gather_cuts(const Cuts& cuts, Participant& self);

}  // namespace rrcb
