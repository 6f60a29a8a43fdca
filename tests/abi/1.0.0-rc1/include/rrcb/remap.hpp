#pragma once

#include <rrcb/plan.hpp>
#include <rrcb/tree_shape.hpp>

#include <mpi.h>

#include <span>
#include <vector>

namespace rrcb {

/// A permutation of the numbers of parts, and the number of points that it keeps. It is the same on
/// every rank.
struct Remap {
    std::vector<Part> numbers;    ///< new number of each part
    bool identity = true;         ///< whether numbers[p] is p for all p: no gain
    GlobalCount num_points = 0;   ///< over all ranks
    GlobalCount kept_before = 0;  ///< points that stay if no number changes
    GlobalCount kept_after = 0;   ///< points that stay under the new numbers, never fewer
};

/// Numbers the parts of a new partition so that many points stay on their rank. Collective.
///
/// The largest overlap of a rank and a part gets its number first, then the next one. Without
/// groups this keeps at least half as many points as possible. Numbers remain unchanged if there is
/// no gain, or if there are more than 2^17 parts.
/// @param parts          the new part of each point of this rank
/// @param ranks_of_parts one entry per part, ascending, the same on every rank; if a part has
/// several ranks, the first one counts
/// @param comm           of the ranks with points
/// @param shape          of the cuts; parts of a group stay in one group, which keeps fewer points
/// Throws the same Error on every rank if a rank names a part that does not exist, or ranks that do
/// not exist or differ between ranks, or if memory runs out. Cost: one pass to rank 0, which
/// decides, and one broadcast.
[[nodiscard]] RRCB_API Remap remap(std::span<const Part> parts,
                                   std::span<const RankRange> ranks_of_parts, MPI_Comm comm,
                                   const TreeShape& shape = {});

/// Numbers the parts so that many points keep the number of their part. Collective.
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
