#pragma once

#include "cut_search.hpp"

#include <mpi.h>

#include <span>
#include <vector>

namespace rrcb {

/// Histograms of all ranks joined at the root: extents by maximum, weights and counts by sum.
///
/// Collective over `comm`. `mine` holds one histogram of layout.length() after the other; the
/// result is as long at the root and empty elsewhere.
std::vector<double> join_histograms(std::span<const double> mine, const HistogramLayout& layout,
                                    int root, MPI_Comm comm);

/// Records of all ranks at the root, one list per search, in the order of the ranks.
///
/// Collective over `comm`. `mine` holds this rank's records for each search; empty lists elsewhere
/// than at the root.
std::vector<std::vector<double>> gather_candidates(std::span<const std::vector<double>> mine,
                                                   int root, MPI_Comm comm);

}  // namespace rrcb
