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
    GlobalCount kept_before = 0;  ///< points that stay when no number changes
    GlobalCount kept_after = 0;   ///< points that stay under the new numbers, never fewer
};

/// Numbers the parts of a new partition so that many points stay on their rank. Collective.
///
/// The largest overlap of a rank and a part gets its number first, which keeps at least half of the
/// points that any numbers can keep, without groups. Numbers that gain nothing are left unchanged.
/// @param parts          the new part of each point of this rank
/// @param ranks_of_parts one entry per part, ascending, the same on every rank; of several ranks of
/// a part the first one counts
/// @param comm           of the ranks with points
/// @param shape          of the cuts: parts of a group stay in one, which keeps fewer points
/// Throws Error on every rank if one names a part that does not exist, ranks that differ or do not
/// exist, or has no memory. Cost: one pass to rank 0, which decides, and one broadcast; with more
/// parts and ranks than Tuning::central_parts, passes through all ranks.
[[nodiscard]] RRCB_API Remap remap(std::span<const Part> parts,
                                   std::span<const RankRange> ranks_of_parts, MPI_Comm comm,
                                   const TreeShape& shape = {});

/// Numbers the parts so that many points keep the number of their part. Collective.
///
/// @param parts          as above
/// @param previous       the earlier part of each point; parts that no longer exist are ignored
/// @param ranks_of_parts as above
/// @param comm           as above
/// @param shape          as above
/// Throws Error as above.
[[nodiscard]] RRCB_API Remap remap(std::span<const Part> parts, std::span<const Part> previous,
                                   std::span<const RankRange> ranks_of_parts, MPI_Comm comm,
                                   const TreeShape& shape = {});

}  // namespace rrcb
