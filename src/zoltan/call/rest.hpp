#pragma once

#include "zoltan/call/objects.hpp"
#include "zoltan/handle/state.hpp"

#include <cstdint>
#include <span>

namespace rrcb::zoltan {

/// Adds a number for each object of this rank to that of its part, whatever their order: made of
/// its weights and, where they are asked for, its coordinates. Not collective.
void add_checksums(const Parameters& parameters, const Workspace& workspace, const Points& points,
                   bool with_positions, std::span<const Part> parts,
                   std::span<std::uint64_t> checksums);

/// Whether each part has a rank of its own, and all objects of this rank are in its part: what they
/// are without a callback that names their parts. Not collective.
bool are_in_own_part(const Objects& objects, const PartMap& map, int rank);

/// Whether every object of this rank is in the part that the last partition gave it, and the parts
/// of this rank hold what they got. Never where the parts of the objects are not known: without a
/// callback that names them only one part on each rank tells. Not collective.
bool is_at_rest(const Rest& rest, const KeptPartition& kept, const Parameters& parameters,
                const Workspace& workspace, const Objects& objects, int rank);

}  // namespace rrcb::zoltan
