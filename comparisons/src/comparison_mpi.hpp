#pragma once

#include "arguments.hpp"
#include "results_folder_mpi.hpp"
#include "table.hpp"

#include <mpi.h>

namespace comparisons {

/// A comparison on a workload, without measurements yet. Collective over `comm`.
Comparison describe(const Workload& workload, const MeasurementPlan& plan, MPI_Comm comm);

/// Measures all methods on a workload, prints their table and writes the data of its pictures.
/// Collective over `comm`.
Comparison compare_methods(const Workload& workload, const Arguments& arguments,
                           const ResultsFolder& folder, Progress& progress, MPI_Comm comm);

}  // namespace comparisons
