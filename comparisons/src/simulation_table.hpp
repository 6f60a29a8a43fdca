#pragma once

#include "simulation_rounds.hpp"

#include <cstdint>
#include <ostream>
#include <span>
#include <string>

namespace comparisons {

/// The fields a row of simulation.csv starts with, `method` to `every`: what was run.
std::string simulation_key(const SimulationPlan& plan, int num_ranks, std::int64_t num_points,
                           const std::string& method);

/// Names of the columns of simulation.csv.
std::string simulation_header();

/// The row of a simulation run once, in the columns of simulation_header.
void write_simulation(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                      const SimulationRun& run);

/// simulation.csv: one row per method, columns as README.md describes them.
void write_simulations(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationSummary> summaries);

/// simulation_runs.csv: one row per method and round.
void write_rounds(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                  std::span<const SimulationRounds> methods);

/// history.csv: the load of every part at the recorded steps.
void write_history(std::ostream& out, std::span<const SimulationRun> runs);

/// The simulations for people; the first is what the others are compared with.
void print_simulations(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationSummary> summaries);

}  // namespace comparisons
