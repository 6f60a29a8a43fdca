#pragma once

#include <rrcb/cuts.hpp>

#include <mpi.h>

namespace rrcb {

/// The whole tree of cuts of which each rank holds a part.
///
/// Collective over `comm`, that of the balance: one reduction of 32 bytes a part, which every rank
/// has to hold. Cuts that are whole come back as they are. Throws Error on every rank alike: where
/// the ranks hold cuts of trees of other dimensions or numbers of parts, where one lacks a cut that
/// a balance on this communicator would have left with it, or has no memory.
RRCB_API Cuts whole_cuts(const Cuts& cuts, MPI_Comm comm);

}  // namespace rrcb
