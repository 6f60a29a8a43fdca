#pragma once

#include "simulation_mpi.hpp"

#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace comparisons {

/// The simulations under one method, one of each round; at least one.
struct SimulationRounds {
    std::string method;
    std::vector<SimulationRun> runs;  ///< none after one that failed

    bool has_failed() const { return !runs.empty() && !runs.back().error.empty(); }
};

/// simulation_runs.csv: one row per method and round, columns as columns.md describes them.
std::string rounds_csv(const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationRounds> methods);

/// history.csv: the load of every part at the recorded steps of the first round.
std::string history_csv(std::span<const SimulationRounds> methods);

/// Prints the range of the critical paths in the latest round, in a line, and why a method failed.
void print_round(std::ostream& out, int number, std::span<const SimulationRounds> methods);

}  // namespace comparisons
