#pragma once

#include "arguments.hpp"
#include "progress.hpp"
#include "results_folder_mpi.hpp"

#include <mpi.h>

namespace comparisons {

/// What accuracy costs, and the paper's parameter study. Collective over `comm`.
///
/// The parts of it that `arguments.only` names: `clouds`, every method and setting on every cloud;
/// `sources`, where the error of an estimate comes from (error_sources.csv); `snapshots`, the
/// paper's settings on the failing slope (with the clouds in sweep.csv); `cycle`, calls again and
/// again on points that stand still (cycle.csv); `simulations` under the paper's settings, and
/// `ranks`, under the standard ones (both sweep_simulation.csv); `paper`, rebalanced at every step
/// (paper_simulation.csv). What these files hold from an earlier run is not measured again. True
/// when nothing failed.
bool run_sweep(const Arguments& arguments, const ResultsFolder& folder, Progress& progress,
               MPI_Comm comm);

}  // namespace comparisons
