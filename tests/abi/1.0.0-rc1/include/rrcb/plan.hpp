#pragma once

#include <rrcb/points.hpp>
#include <rrcb/stamp.hpp>

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

struct Balance;

/// Consecutive ranks that hold a part.
struct RankRange {
    int first_rank = 0;  ///< the lowest of them
    int count = 1;       ///< of ranks

    bool contains(int rank) const { return rank >= first_rank && rank < first_rank + count; }
};

/// Returns the ranks of a part, as Zoltan 13.2 assigns them. Not collective.
///
/// Each rank has num_parts / num_ranks parts; the last ranks have one more each for the remainder.
/// If there are fewer parts than ranks, each part has num_ranks / num_parts consecutive ranks; the
/// remaining ranks go to the parts before the last one, one to each. Example: of 5 parts on 3
/// ranks, rank 0 has part 0, rank 1 has parts 1 and 2, and rank 2 has parts 3 and 4.
/// @param part      0 ... num_parts - 1
/// @param num_parts 1 or more
/// @param num_ranks 1 or more
/// Throws Error for other numbers.
RRCB_API RankRange ranks_of_part(Part part, int num_parts, int num_ranks);

/// Number of points to or from one rank.
struct RankCount {
    int rank = 0;          ///< of the communicator
    LocalIndex count = 0;  ///< of points
};

/// Points to send and to receive, for transfer(). Entry k of all export lists describes one point,
/// and so does entry k of all import lists.
struct Plan {
    LocalIndex num_points = 0;               ///< of this rank before
    std::vector<LocalIndex> export_indices;  ///< points that leave this rank, ascending
    std::vector<int> export_ranks;           ///< their destinations
    std::vector<Part> export_parts;          ///< their new parts
    std::vector<int> import_ranks;           ///< sources of the points that arrive, ascending
    std::vector<LocalIndex> import_indices;  ///< their indices on the source, ascending for each
                                             ///< rank
    std::vector<Part> import_parts;          ///< their new parts
    Stamp stamp{};                           ///< of the call, see unstamped()
};

/// Makes the export and import lists of the points whose rank changes. Collective.
///
///     const rrcb::Plan moves = rrcb::plan(balance.parts, num_parts, comm);
///
/// @param parts     the new part, 0 ... num_parts - 1, of each point of this rank
/// @param num_parts 1 or more, the same on every rank
/// @param comm      of the ranks with points
/// Throws the same Error on every rank if a rank gives other numbers. Cost: ceil(log2 R) messages
/// from each of R ranks, one more from some of them, one reduction, and one message for each pair
/// of ranks between which points move; memory for these points and their other ranks. Memory does
/// not grow with the number of ranks or of parts.
[[nodiscard]] RRCB_API Plan plan(std::span<const Part> parts, int num_parts, MPI_Comm comm);

/// Makes the same lists from a balance. Collective.
///
/// @param balance of the points of this rank
/// @param comm    of the balance, or a congruent one
/// Throws the same Error on every rank, also if the communicator has other ranks.
[[nodiscard]] RRCB_API Plan plan(const Balance& balance, MPI_Comm comm);

}  // namespace rrcb
