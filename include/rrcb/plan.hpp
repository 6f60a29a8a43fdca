#pragma once

#include <rrcb/points.hpp>

#include <mpi.h>

#include <span>
#include <vector>

namespace rrcb {

struct Balance;

/// Consecutive ranks that hold a part.
struct RankRange {
    int first_rank = 0;  ///< the lowest of them
    int count = 1;       ///< of ranks
};

/// Returns the ranks of a part, as Zoltan 13.2 lays them out. Not collective.
///
/// num_parts / num_ranks parts each, the remainder one more each on the last ranks; with fewer
/// parts than ranks a part spreads over consecutive ranks, the ranks left over one more each for
/// the parts before the last. Throws Error unless 0 <= part < num_parts and num_ranks >= 1.
RRCB_API RankRange ranks_of_part(Part part, int num_parts, int num_ranks);

/// So many points, to or from one rank.
struct RankCount {
    int rank = 0;          ///< of the communicator
    LocalIndex count = 0;  ///< of points
};

/// Who sends what to whom, which transfer() does; entry k of each list on this side describes one
/// point.
struct Plan {
    LocalIndex num_points = 0;               ///< that this rank holds before
    std::vector<LocalIndex> export_indices;  ///< of my points that leave, ascending
    std::vector<int> export_ranks;           ///< where they go
    std::vector<Part> export_parts;          ///< their new parts
    std::vector<int> import_ranks;           ///< where my new points come from, ascending
    std::vector<LocalIndex> import_indices;  ///< their index there, ascending per rank
    std::vector<Part> import_parts;          ///< their new parts
};

/// Makes the export and import lists of the points whose rank changes.
///
/// Collective over `comm`. `parts` has one entry in 0 ... num_parts - 1 per local point. Throws
/// Error on every rank alike if some rank names a part outside that range, another num_parts, or
/// one below 1. Cost: ceil(log2 R) messages from each of R ranks, one more from some, one
/// reduction, and one message for each pair between which points move; memory for the points that
/// leave and come, and 100 bytes for each rank that they go to or come from. None grows with the
/// number of ranks or parts.
RRCB_API Plan plan(std::span<const Part> parts, int num_parts, MPI_Comm comm);

/// Makes the same lists from the parts of a balance. Collective over `comm`.
RRCB_API Plan plan(const Balance& balance, MPI_Comm comm);

}  // namespace rrcb
