#pragma once

#include "simulation_mpi.hpp"

#include <ostream>
#include <span>

namespace comparisons {

/// simulation.csv: one row per simulation, columns as README.md describes them.
void write_simulations(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationRun> runs);

/// history.csv: the load of every part at the recorded steps.
void write_history(std::ostream& out, std::span<const SimulationRun> runs);

/// The simulations for people; the first run is what the others are compared with.
void print_simulations(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationRun> runs);

}  // namespace comparisons
