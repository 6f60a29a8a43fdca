#pragma once

#include "measurement_mpi.hpp"
#include "results_folder_mpi.hpp"

#include <mpi.h>

#include <span>

namespace comparisons {

/// Writes the data of a workload's pictures: data/points_*, boxes_*, cells_* and statistical_*.
///
/// Collective over `comm`. `measurements` are those of `methods`, in the same order. Methods that
/// have failed are skipped.
void write_plot_data(const ResultsFolder& folder, const Workload& workload,
                     std::span<const Method> methods, std::span<const Measurement> measurements,
                     MPI_Comm comm);

}  // namespace comparisons
