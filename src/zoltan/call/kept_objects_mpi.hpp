#pragma once

#include "zoltan/call/objects.hpp"
#include "zoltan/handle/state.hpp"

#include <mpi.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rrcb::zoltan {

/// Returns a checksum of this rank's objects and their parts. The checksums of the ranks can be
/// added up; the sum does not depend on the order of the objects or on their distribution.
///
/// By the checksum a repeated call recognizes objects that have not changed, at a cost of about 30
/// instructions for each. Without it, calls from scratch or with coincident objects might move
/// objects in every call.
std::uint64_t checksum_of(const Points& points, std::span<const Part> parts);

/// Finds the parts of this rank's objects and writes them into `parts`. Asks a callback or, if each
/// rank has one part, uses the rank. Returns the checksum of all objects; nullopt if the part of
/// one is unknown or on other ranks, or if the last cuts put it into another part. Throws
/// std::bad_alloc. Not collective.
std::optional<std::uint64_t> checksum_in_place(const Objects& objects, LastPartition& last,
                                               const KeptObjects& kept, int rank,
                                               std::vector<Part>& parts);

/// Returns whether an object moves on any rank, and adds up the checksums of all ranks. Collective:
/// one reduction.
bool add_up(bool moves_here, std::uint64_t& checksum, MPI_Comm comm);

}  // namespace rrcb::zoltan
