#pragma once

#include "cloud.hpp"
#include "layout_mpi.hpp"
#include "workload.hpp"

#include <mpi.h>

#include <cstdint>
#include <string>

namespace comparisons {

/// Generates a cloud, every rank its share. Collective over `comm`.
///
/// The point set does not depend on the number of ranks. Throws Failure for an unknown name.
Workload cloud_workload(const Cloud& cloud, Layout layout, MPI_Comm comm);

/// Reads a file of points on rank 0 and sends every rank its share. Collective over `comm`.
///
/// Throws Failure on every rank with the message of read_points.
Workload file_workload(const std::string& file, Layout layout, std::uint64_t seed, MPI_Comm comm);

}  // namespace comparisons
