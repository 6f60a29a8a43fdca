#pragma once

#include "workload.hpp"

#include <mpi.h>

#include <cstdint>
#include <vector>

namespace comparisons {

/// How the points lie on the ranks before they are balanced.
enum class Layout {
    sorted,    ///< each rank holds a piece of equal count of a Hilbert curve through the points
    scattered  ///< each point lies on a random rank
};

const char* layout_name(Layout layout);

/// Box around the points of all ranks. Collective over `comm`.
rrcb::Box global_box(const Workload& workload, MPI_Comm comm);

/// Sends every point to its rank; `workload` holds any distribution of them.
///
/// Collective over `comm`. Depends on the points and the number of ranks alone when each rank
/// holds a piece of one global order, ranks in order.
void distribute(Workload& workload, Layout layout, std::uint64_t seed, MPI_Comm comm);

/// Sends row i of `rows` (of `width` doubles) to ranks[i]; rows come in the order of the senders.
/// Collective over `comm`.
std::vector<double> exchange(const std::vector<double>& rows, int width,
                             const std::vector<int>& ranks, MPI_Comm comm);

}  // namespace comparisons
