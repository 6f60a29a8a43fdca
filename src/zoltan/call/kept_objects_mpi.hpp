#pragma once

#include "zoltan/call/objects.hpp"
#include "zoltan/handle/state.hpp"

#include <mpi.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rrcb::zoltan {

/// Returns a checksum of the objects of this rank and of their parts. Checksums of several ranks
/// add up, whatever the order of the objects and their distribution.
///
/// A repeated call finds objects at rest by it, for about 30 instructions an object. Without it,
/// calls from nothing or with coincident objects may move them for ever.
std::uint64_t checksum_of(const Points& points, std::span<const Part> parts);

/// Finds the parts of the objects of this rank, by a callback or, with a part on each rank, by the
/// rank, and writes them into `parts`. Returns the checksum of all; nothing if the part of one is
/// unknown or on other ranks, or the last cuts put it elsewhere. Throws std::bad_alloc. Not
/// collective.
std::optional<std::uint64_t> checksum_in_place(const Objects& objects, LastPartition& last,
                                               const KeptObjects& kept, int rank,
                                               std::vector<Part>& parts);

/// Returns whether an object moves on any rank, and adds up the checksums of all ranks. Collective:
/// one reduction.
bool add_up(bool moves_here, std::uint64_t& checksum, MPI_Comm comm);

}  // namespace rrcb::zoltan
