#pragma once

#include "noise.hpp"
#include "simulation_mpi.hpp"
#include "statistics.hpp"

#include <cstdint>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace comparisons {

/// The simulations under one method, one of each round; at least one.
struct SimulationRounds {
    std::string method;
    std::vector<SimulationRun> runs;  ///< none after one that failed
};

/// What the rounds of a method come to.
struct SimulationSummary {
    SimulationRun middle;  ///< medians over the rounds; where one failed, its error alone
    int repeats = 1;
    Spread wall_s;
    Spread critical_path_s;
    Spread mean_imbalance;                         ///< a single value where no seed changes it
    std::optional<Spread> speed_up_critical_path;  ///< over no rebalancing, of the same round
    std::optional<double> ideal_speed_up;  ///< if rebalancing were free and as good as any here
    std::optional<double> gain_kept;       ///< share of what could be gained that was
};

/// The rounds of one method alone: without what is to be compared.
SimulationSummary summarize(const SimulationRounds& rounds);

/// The rounds of all methods beside the first, which does not rebalance.
///
/// The ideal: no rebalancing's critical path / the shortest path of the steps alone under any
/// method. Kept is (none - method) / (none - that shortest path); nothing where none is the
/// shortest.
std::vector<SimulationSummary> summarize_all(std::span<const SimulationRounds> methods);

/// No rebalancing beside a second time of the same rounds: by the clock and on the critical path.
/// Nothing where one of them failed.
std::vector<Noise> noise_of(const std::string& scene, const SimulationRounds& none,
                            const SimulationRounds& again);

/// A row of simulation.csv, columns as columns.md describes them.
Row simulation_row(const SimulationPlan& plan, int num_ranks, const SimulationSummary& summary);

/// simulation_runs.csv: one row per method and round.
std::string rounds_csv(const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationRounds> methods);

/// history.csv: the load of every part at the recorded steps.
std::string history_csv(std::span<const SimulationRun> runs);

/// The simulations for people; the first is what the others are compared with.
void print_simulations(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationSummary> summaries);

}  // namespace comparisons
