#pragma once

#include <rrcb/points.hpp>

#include <mpi.h>

#include <span>
#include <vector>

namespace rrcb {

struct Balance;

/// Returns heaviest part / mean part: max_p (weight_p / size_p) * sum(size) / sum(weight).
///
/// Not collective. `part_sizes` are relative, one per part, or empty for equal parts. Parts of size
/// 0 are left out unless they hold weight; then the imbalance is infinite. It is 1 if there is no
/// weight at all, NaN if the sum of the weights is not finite. Throws Error if there are sizes for
/// another number of parts.
RRCB_API double imbalance(std::span<const double> part_weights,
                          std::span<const double> part_sizes = {});

/// Returns the load unbalance of each part in percent: (ideal - actual) / ideal * 100. Not
/// collective.
///
/// One entry per part; sizes as for imbalance(). The Lu of the CILAMCE 2020 paper: negative if a
/// part holds too much; 0 for a part of size 0.
RRCB_API std::vector<double> load_unbalance_percent(std::span<const double> part_weights,
                                                    std::span<const double> part_sizes = {});

/// Returns the largest absolute value of load_unbalance_percent(). Not collective.
RRCB_API double worst_load_unbalance_percent(std::span<const double> part_weights,
                                             std::span<const double> part_sizes = {});

/// Returns the weight of every part over all ranks, length num_parts, on every rank.
///
/// Collective over `comm`: two reductions. `parts` holds one entry in 0 ... num_parts - 1 per local
/// point. Throws Error on all ranks if one holds other parts, has weights of another length, or
/// names another num_parts or one below 1.
RRCB_API std::vector<double> part_weights(const Points& points, std::span<const Part> parts,
                                          int num_parts, MPI_Comm comm);

/// Returns the weight of every part of a balance of these points. Collective over `comm`.
RRCB_API std::vector<double> part_weights(const Points& points, const Balance& balance,
                                          MPI_Comm comm);

/// Returns the share of the weight, 0 ... 1, whose rank is not among the ranks of its new part.
///
/// Collective over `comm`: two reductions. `parts` and errors are as for part_weights(). NaN if the
/// weights are.
RRCB_API double moved_fraction(const Points& points, std::span<const Part> parts, int num_parts,
                               MPI_Comm comm);

/// Returns the share that moves by a balance of these points. Collective over `comm`.
RRCB_API double moved_fraction(const Points& points, const Balance& balance, MPI_Comm comm);

}  // namespace rrcb
