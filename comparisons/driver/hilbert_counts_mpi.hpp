#pragma once

#include "partitioner.hpp"
#include "workload_mpi.hpp"

#include <mpi.h>

#include <memory>

namespace comparisons {

/// Returns a partitioner that cuts a Hilbert curve by counting keys, as many codes do.
///
/// Cells of the curve that hold more than a hundredth of the mean part are divided. The new cells
/// are counted by a reduction, until no cell is too heavy. Parts begin at the cells nearest to even
/// shares. The parts balance to about 1 % unless many points share a key. The method is that of
/// Keller, Cavelan, Cabezon, Mayer, Ciorba: Cornerstone: octree construction algorithms for
/// scalable particle simulations (2023). The workload must outlive the partitioner.
std::unique_ptr<Partitioner> make_hilbert_counts(const Workload& workload, MPI_Comm comm);

}  // namespace comparisons
