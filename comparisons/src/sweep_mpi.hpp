#pragma once

#include "arguments.hpp"
#include "progress.hpp"
#include "results_folder_mpi.hpp"

#include <mpi.h>

namespace comparisons {

/// What accuracy costs, and the paper's parameter study. Collective over `comm`.
///
/// Measures `arguments.methods` on every cloud, in two and three dimensions, sorted and scattered;
/// then the paper's settings of rrcb-sampled on snapshots of the failing slope (both in sweep.csv)
/// and in simulations of it beside a serial one (sweep_simulation.csv). What these files hold from
/// an earlier run is not measured again. True when nothing failed.
bool run_sweep(const Arguments& arguments, const ResultsFolder& folder, Progress& progress,
               MPI_Comm comm);

}  // namespace comparisons
