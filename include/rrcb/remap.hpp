#pragma once

#include <rrcb/plan.hpp>

#include <mpi.h>

#include <span>
#include <vector>

namespace rrcb {

/// A permutation of the part numbers, and what it saves; the same on every rank.
struct Remap {
    std::vector<Part> numbers;    ///< new number of each part
    bool identity = true;         ///< numbers[p] is p: nothing to gain
    GlobalCount num_points = 0;   ///< over all ranks
    GlobalCount kept_before = 0;  ///< of the points, those that stay when no number changes
    GlobalCount kept_after = 0;   ///< those that stay under the new numbers, never fewer
};

/// Numbers the parts of a new partition so that few points leave their rank.
///
/// Collective over `comm`: one reduction, one gather, one broadcast; or, beyond 64 ranks and 128
/// parts that lie as ranks_of_part() tells, passes through the ranks, by which no rank hears of all
/// overlaps and all together find the same numbers in 16 rounds at most. `parts` is the new part of
/// each local point, `ranks_of_parts` has one entry per part, ascending, the same on every rank; of
/// several ranks of a part the first one counts. Throws Error on every rank when one names a part
/// that is none, ranks of parts that are not as told or other ones than the others, or has no
/// memory.
///
/// Every rank tells the root its heaviest overlaps, 16 per part it holds, so up to 16 parts all
/// of them; counts are of what was told. The root finds the permutation that keeps most: up to 128
/// parts by the Hungarian method (Kuhn 1955, Munkres 1957), beyond that greedily, which keeps at
/// least half of the most. Where nothing is gained the numbers stay as they are. Meant for parts of
/// equal size: sizes are not looked at.
RRCB_API Remap remap(std::span<const Part> parts, std::span<const RankRange> ranks_of_parts,
                     MPI_Comm comm);

/// The same, so that few points change the number of their part.
///
/// `previous` is the part each local point was in, as long as `parts`; numbers that are no part any
/// more count nothing. Up to 128 parts the root is told all overlaps, by a reduction of parts^2
/// numbers in place of the gather, and no permutation keeps more.
RRCB_API Remap remap(std::span<const Part> parts, std::span<const Part> previous,
                     std::span<const RankRange> ranks_of_parts, MPI_Comm comm);

}  // namespace rrcb
