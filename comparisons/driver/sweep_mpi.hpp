#pragma once

#include "arguments.hpp"
#include "progress.hpp"
#include "results_folder_mpi.hpp"
#include "row.hpp"
#include "workload_mpi.hpp"

#include <mpi.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace comparisons {

/// A CSV file that grows row by row and survives an interrupted run.
///
/// Every rank holds the same rows; all functions but `has` are collective.
class SavedRows {
  public:
    /// Takes over the rows of an earlier file with the same columns and writes them again; rows
    /// that failed or were cut short are left out, so that they are measured again.
    SavedRows(const ResultsFolder& folder, std::string name, Row columns);

    /// Whether there is a row with the key of this one.
    bool has(const Row& row) const { return keys_.contains(row.key()); }

    /// Adds rank 0's rows, but those whose key is there, and saves the file. True when none of
    /// them failed.
    bool add(const std::vector<Row>& rows);

  private:
    void add_and_save(const std::vector<Row>& rows);

    const ResultsFolder& folder_;
    std::string name_;
    Row columns_;
    std::vector<Row> rows_;
    std::set<std::string> keys_;
};

/// What all parts of a sweep work with.
struct Sweep {
    const Arguments& arguments;
    const ResultsFolder& folder;
    Progress& progress;
    MPI_Comm comm;
    int rank = 0;
    int num_ranks = 1;

    /// Whether `part` is asked for.
    bool includes(const std::string& part) const;

    /// Prints a line on rank 0.
    void say(const std::string& line) const;
};

/// Calls `visit` with every cloud asked for, `num_points` each; true when all calls were.
/// Collective.
bool on_each_cloud(const Sweep& sweep, rrcb::GlobalCount num_points,
                   const std::function<bool(const Workload&)>& visit);

/// Measures the settings that have no row yet, Zoltan's RCB always among them for comparison.
/// True when none failed. Collective.
bool measure_missing(const Sweep& sweep, const Workload& workload, std::vector<Method> settings,
                     SavedRows& rows);

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

/// What accuracy costs, and the paper's parameter study. Collective over `comm`.
///
/// The parts of it that `arguments.only` names: `clouds`, every method and setting on every cloud;
/// `snapshots`, the paper's settings on the failing slope (with the clouds in sweep.csv); `cycle`,
/// calls again and again on points that stand still (cycle.csv); `simulations` under the paper's
/// settings, and `ranks`, under the standard ones (both sweep_simulation.csv); `paper`, rebalanced
/// at every step (paper_simulation.csv). What these files hold from an earlier run is not measured
/// again. True when nothing failed.
bool run_sweep(const Arguments& arguments, const ResultsFolder& folder, Progress& progress,
               MPI_Comm comm);

}  // namespace comparisons
