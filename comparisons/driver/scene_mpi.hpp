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

/// The simulations under one method, one of each round; at least one.
struct SimulationRounds {
    std::string method;
    std::vector<SimulationRun> runs;      ///< none after one that failed
    std::optional<Method> balanced_by{};  ///< none: nothing is rebalanced
    Cost cost = Cost::count;
    int every = 0;  ///< as in SimulationPlan

    bool has_failed() const { return !runs.empty() && !runs.back().error.empty(); }
};

/// Is called with the points at the start, middle and end of the run without rebalancing, as they
/// lie on its ranks: a distribution that favours no method.
using SnapshotVisitor = std::function<void(std::span<const Workload> snapshots)>;

/// How the scene asked for is run: the options, or what they leave to the scene. `num_runs`
/// simulations share the space of the history. Collective over `comm`; throws Failure as
/// choose_scene does.
SimulationPlan plan_scene(const Arguments& arguments, std::size_t num_runs, MPI_Comm comm);

/// Where the points lie now, as a workload of that name. Not collective.
Workload snapshot(const std::string& name, const mpm::Simulation& simulation);

/// The same snapshots, from a run without rebalancing alone. Collective over `comm`.
///
/// Throws Failure when the simulation fails.
std::vector<Workload> scene_snapshots(const SimulationPlan& plan, Progress& progress,
                                      MPI_Comm comm);

/// Runs the scene under every method that cuts along the axes, several rounds of all of them,
/// writes the times and loads of each run, and prints a line a round. Collective over `comm`.
///
/// The first runs without rebalancing, as "none". The second is measured twice, the last of all as
/// "... again": how far the two differ is noise.
/// The slope ends when its front lies still, unless steps or simulations only are asked for.
/// `visit` is called behind the first round, so that nobody waits for all of them to see a table.
/// With learned costs there are two more: "count" and "learned" weigh the points of rrcb-arrays.
/// Methods that vary with the seed take another one each round.
std::vector<SimulationRounds> run_scene(const Arguments& arguments, const ResultsFolder& folder,
                                        Progress& progress, const SnapshotVisitor& visit,
                                        MPI_Comm comm);

/// simulation_runs.csv: one row per method and round, columns as columns.md describes them.
std::string rounds_csv(const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationRounds> methods);

/// history.csv: the load of every part at the recorded steps of the first round.
std::string history_csv(std::span<const SimulationRounds> methods);

/// Rounds of simulations: those done, all, and seconds that they took.
struct RoundsDone {
    int number = 0;
    int of = 0;
    double elapsed_s = 0;
};

/// Prints the range of the critical paths in the latest round and how long is left, in a line, and
/// why a method failed.
void print_round(std::ostream& out, const RoundsDone& done,
                 std::span<const SimulationRounds> methods);

}  // namespace comparisons
