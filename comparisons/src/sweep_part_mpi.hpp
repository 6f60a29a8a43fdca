#pragma once

#include "arguments.hpp"
#include "progress.hpp"
#include "results_folder_mpi.hpp"
#include "saved_rows_mpi.hpp"
#include "workload.hpp"

#include <mpi.h>

#include <functional>
#include <string>
#include <vector>

namespace comparisons {

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

}  // namespace comparisons
