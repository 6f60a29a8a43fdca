#pragma once

#include <rrcb/plan.hpp>
#include <rrcb/tree_shape.hpp>

#include <mpi.h>

#include <span>
#include <vector>

namespace rrcb {

/// A permutation of the part numbers, and the number of points it keeps; the same on every rank.
struct Remap {
    std::vector<Part> numbers;    ///< new number of each part
    bool identity = true;         ///< numbers[p] is p: no gain
    GlobalCount num_points = 0;   ///< over all ranks
    GlobalCount kept_before = 0;  ///< staying points if no number changes
    GlobalCount kept_after = 0;   ///< staying points under the new numbers, never fewer
};

/// Numbers the parts of a new partition: many points then stay on their rank. Collective.
///
/// The largest overlap of a rank and a part gets its number first. Without groups this keeps at
/// least half of the most points. Numbers without a gain are left unchanged, and so are those of
/// more than 2^17 parts.
/// @param parts          the new part of each point of this rank
/// @param ranks_of_parts one entry per part, ascending, the same on every rank; of several ranks of
/// a part the first one counts
/// @param comm           of the ranks with points
/// @param shape          of the cuts: parts of a group stay in one, which keeps fewer points
/// Throws Error on every rank if one names no existing part, ranks that differ or do not exist, or
/// has no memory. Cost: one pass to rank 0, which decides, and one broadcast.
[[nodiscard]] RRCB_API Remap remap(std::span<const Part> parts,
                                   std::span<const RankRange> ranks_of_parts, MPI_Comm comm,
                                   const TreeShape& shape = {});

/// Numbers the parts: many points then keep the number of their part. Collective.
///
/// @param parts          as above
/// @param previous       the earlier part of each point; numbers beyond the parts are ignored
/// @param ranks_of_parts as above
/// @param comm           as above
/// @param shape          as above
/// Throws Error as above.
[[nodiscard]] RRCB_API Remap remap(std::span<const Part> parts, std::span<const Part> previous,
                                   std::span<const RankRange> ranks_of_parts, MPI_Comm comm,
                                   const TreeShape& shape = {});

}  // namespace rrcb
