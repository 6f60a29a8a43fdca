#pragma once

#include <rrcb/points.hpp>

#include <mpi.h>

#include <span>
#include <vector>

namespace rrcb {

struct Balance;

/// Returns the imbalance, heaviest part / mean part: max_p (weight_p / size_p) * sum(size) /
/// sum(weight). Not collective.
///
/// @param part_weights weight of each part
/// @param part_sizes   relative, one per part, or empty for equal parts
/// @return 1 if there is no weight; NaN if the sum of the weights is not finite; infinity if a part
/// of size 0 has weight. Other parts of size 0 are ignored
/// Throws Error if the number of sizes is not that of the parts.
RRCB_API double imbalance(std::span<const double> part_weights,
                          std::span<const double> part_sizes = {});

/// Returns the weight of every part over all ranks, on every rank. Collective: two reductions.
///
/// @param points    of this rank
/// @param parts     one entry in 0 ... num_parts - 1 for each point
/// @param num_parts the same on every rank; length of the result
/// @param comm      of the ranks with points
/// Throws Error on all ranks if one gives other parts or numbers, or weights of another length.
RRCB_API std::vector<double> part_weights(const Points& points, std::span<const Part> parts,
                                          int num_parts, MPI_Comm comm);

/// Returns the weight of every part of a balance of these points. Collective.
///
/// @param points  of this rank
/// @param balance of these points
/// @param comm    of the balance
RRCB_API std::vector<double> part_weights(const Points& points, const Balance& balance,
                                          MPI_Comm comm);

/// Returns which share of the weight, from 0 to 1, has to move because its rank does not hold its
/// new part. Collective: two reductions.
///
/// @param points    of this rank
/// @param parts     as for part_weights()
/// @param num_parts as for part_weights()
/// @param comm      as for part_weights()
/// @return NaN if weights are NaN
/// Throws Error as part_weights().
RRCB_API double moved_fraction(const Points& points, std::span<const Part> parts, int num_parts,
                               MPI_Comm comm);

/// Returns which share of the weight a balance of these points moves. Collective.
///
/// @param points  of this rank
/// @param balance of these points
/// @param comm    of the balance
RRCB_API double moved_fraction(const Points& points, const Balance& balance, MPI_Comm comm);

}  // namespace rrcb
