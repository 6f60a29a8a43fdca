#pragma once

#include <rrcb/cuts.hpp>

#include <mpi.h>

#include <vector>

namespace rrcb {

/// The whole tree of cuts of which each rank holds a part.
///
/// Collective over `comm`, that of the balance: one reduction of 32 bytes a part, which every rank
/// has to hold. Cuts that are whole come back as they are. Throws Error on every rank alike: if
/// cuts are no tree, those of the ranks are of trees of other dimensions or numbers of parts, whole
/// trees differ, a rank lacks the cut of a node whose lowest part begins on this rank, or has no
/// memory.
RRCB_API Cuts whole_cuts(const Cuts& cuts, MPI_Comm comm);

/// Part of each of any positions, by cuts of which each rank holds some.
///
/// Collective over `comm`, that of the balance; each rank gives positions of its own, or none, but
/// states their dimension. Where some rank lacks cuts, the ranks share those that they own in one
/// pass through them, of ceil(log2 R) messages each, and ask the owners, with 5 kB in answer for
/// each 127 cuts that a rank asks for. In trees of up to 2^20 parts that takes two questions, one
/// after the other; three after exact cuts, or where a tolerance was missed: then not all ranks
/// know the first ones. Whole cuts are looked up in place.
///
/// Throws Error on every rank alike: for coordinates that are NaN or infinite, positions of another
/// dimension than the cuts, cuts that whole_cuts() would refuse, or no memory.
RRCB_API std::vector<Part> locate(const Cuts& cuts, const Points& positions, MPI_Comm comm);

}  // namespace rrcb
