#pragma once

#include "zoltan/call/objects.hpp"
#include "zoltan/handle/state.hpp"

#include <mpi.h>

#include <cstdint>
#include <span>

namespace rrcb::zoltan {

/// Adds a hash of each object of this rank to the checksum of its part. Not collective.
///
/// It is a hash of the weights, and of the coordinates where they are asked for. The order of the
/// objects does not matter.
void add_checksums(const Parameters& parameters, const Workspace& workspace, const Points& points,
                   bool with_positions, std::span<const Part> parts,
                   std::span<std::uint64_t> checksums);

/// Whether each part has a rank of its own, and all objects of this rank are in its part. Objects
/// whose parts no callback names are. Not collective.
bool are_in_own_part(const Objects& objects, const PartMap& map, int rank);

/// Whether every object of this rank is in the part that the last partition gave it, and the parts
/// of this rank hold the objects they got. Not collective.
///
/// False where the parts of the objects are unknown: without a callback that names them, and
/// several parts on a rank.
bool is_at_rest(const Rest& rest, const KeptPartition& kept, const Parameters& parameters,
                const Workspace& workspace, const Objects& objects, int rank);

/// Whether RRCB_SKIP_WITHIN is set and every object of this rank is where the last cuts tell; what
/// the objects weigh in each part goes into `state.rest`. Not where they cannot be weighed, or
/// their parts are not known. Not collective.
bool are_as_cut(State& state, const Objects& objects);

/// Whether the parts, weighed by are_as_cut(), are within an imbalance. Collective: one reduction.
bool are_even(Rest& rest, double within, MPI_Comm comm);

}  // namespace rrcb::zoltan
