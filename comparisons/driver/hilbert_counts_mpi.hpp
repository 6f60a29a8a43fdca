#pragma once

#include "partitioner.hpp"
#include "workload_mpi.hpp"

#include <mpi.h>

#include <memory>

namespace comparisons {

/// Makes a partitioner that cuts a Hilbert curve by counted keys, as many codes do by hand.
///
/// Cells of the curve with more than a hundredth of the mean part are divided, and the new ones
/// counted by a reduction, until there are none; parts begin at the cells nearest to even shares.
/// Balances to about 1 % unless many points share a key. Follows the trees of Keller, Cavelan,
/// Cabezon, Mayer, Ciorba: Cornerstone: octree construction algorithms for scalable particle
/// simulations (2023). The workload must outlive it.
std::unique_ptr<Partitioner> make_hilbert_counts(const Workload& workload, MPI_Comm comm);

}  // namespace comparisons
