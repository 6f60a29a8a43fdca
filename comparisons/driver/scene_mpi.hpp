#pragma once

#include "arguments.hpp"
#include "results_folder_mpi.hpp"
#include "simulation_mpi.hpp"
#include "workload_mpi.hpp"

#include <mpi.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace comparisons {

/// The simulations with one method, one for each round. There is at least one.
struct SimulationRounds {
    std::string method;
    std::vector<SimulationRun> runs;      ///< a simulation that fails is the last one
    std::optional<Method> balanced_by{};  ///< nullopt: no rebalancing
    Cost cost = Cost::count;
    int every = 0;           ///< as in SimulationPlan
    bool is_serial = false;  ///< runs on rank 0 alone, which alone has the results

    bool has_failed() const { return !runs.empty() && !runs.back().error.empty(); }
};

/// Called with the points at the start, middle and end of the run without rebalancing, in their
/// distribution over its ranks. This distribution favours no method.
using SnapshotVisitor = std::function<void(std::span<const Workload> snapshots)>;

/// Returns the plan for the requested scene: values from the options, or the scene's own if an
/// option is not given. `num_runs` simulations share the space of the history. Collective over
/// `comm`; throws Failure like choose_scene.
SimulationPlan plan_scene(const Arguments& arguments, std::size_t num_runs, MPI_Comm comm);

/// Returns the same snapshots, but runs only the simulation without rebalancing. Collective over
/// `comm`.
///
/// Throws Failure if the simulation fails.
std::vector<Workload> scene_snapshots(const SimulationPlan& plan, MPI_Comm comm);

/// Runs the scene with every method that cuts along the axes, in several rounds. Writes the times
/// and loads of each run, and prints one line per round. Collective over `comm`.
///
/// The first simulation, "none", does not rebalance. The second is run again as the last one, with
/// "again" after its name: the difference between the two is noise. The slope ends when its front
/// has stopped, unless a number of steps is given or only simulations are requested. `visit` is
/// called after the first round. With learned costs "count", "learned" and "known" weigh the points
/// of rrcb-arrays. Methods that vary with the seed use a new seed in each round. "serial" runs on
/// rank 0 while the others wait.
std::vector<SimulationRounds> run_scene(const Arguments& arguments, const ResultsFolder& folder,
                                        const SnapshotVisitor& visit, MPI_Comm comm);

/// Returns the text of simulation_runs.csv, with a row per method and round. columns.md describes
/// it.
std::string rounds_csv(const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationRounds> methods);

/// The number of completed rounds, the number of all rounds, and the seconds that they took.
struct RoundsDone {
    int number = 0;
    int of = 0;
    double elapsed_s = 0;
};

/// Prints in one line the range of the critical paths in the last round and the time left. Also
/// prints why a method failed.
void print_round(std::ostream& out, const RoundsDone& done,
                 std::span<const SimulationRounds> methods);

}  // namespace comparisons
