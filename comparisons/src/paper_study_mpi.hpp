#pragma once

#include "sweep_part_mpi.hpp"

namespace comparisons {

/// The paper's settings and the methods they are judged by, on snapshots of the failing slope.
/// Adds to `rows`; true when none failed. Collective.
bool study_snapshots(const Sweep& sweep, SavedRows& rows);

/// The same in simulations of the slope, beside a serial one: rows of sweep_simulation.csv and the
/// load of every part in data/history_<method>_<ranks>.csv. The repeated_settings are run in turns
/// several times, the others once. True when none failed. Collective.
bool study_simulations(const Sweep& sweep);

/// The methods with their standard settings only, at the number of ranks there are; on six ranks
/// data/{points,boxes,cells,statistical}_six-boxes*.csv as well. Collective.
bool study_ranks(const Sweep& sweep);

/// The simulation rebalanced at every step, as the paper does it, once under the winning settings
/// and what they are judged by: paper_simulation.csv and data/paper_history_<method>_<ranks>.csv.
/// True when none failed. Collective.
bool study_paper(const Sweep& sweep);

}  // namespace comparisons
