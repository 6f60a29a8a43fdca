#pragma once

#include "arguments.hpp"
#include "results_folder_mpi.hpp"
#include "simulation_mpi.hpp"
#include "workload.hpp"

#include <mpi.h>

#include <vector>

namespace comparisons {

/// The slope, run whole under every method.
struct SceneRuns {
    std::vector<SimulationRun> runs;  ///< the first without rebalancing
    /// Points at the start, middle and end of the run without rebalancing, as they lie on its
    /// ranks: a distribution that favours no method.
    std::vector<Workload> snapshots;
};

/// Runs the slope under every method that cuts along the axes, prints and writes their times and
/// loads. Collective over `comm`.
SceneRuns run_scene(const Arguments& arguments, const ResultsFolder& folder, Progress& progress,
                    MPI_Comm comm);

}  // namespace comparisons
