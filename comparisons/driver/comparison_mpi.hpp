#pragma once

#include "arguments.hpp"
#include "measurement_mpi.hpp"
#include "results_folder_mpi.hpp"

#include <mpi.h>

#include <span>
#include <string>
#include <vector>

namespace comparisons {

/// The measurements of all methods on one workload.
struct Comparison {
    std::string workload;
    std::string layout;
    int dimension = 2;
    rrcb::GlobalCount num_points = 0;
    int num_ranks = 1;
    MeasurementPlan plan;
    std::vector<Measurement> measurements;
    std::vector<double> second_times_ms = {};  ///< of zoltan-rcb, which is measured twice in each
                                               ///< turn
};

/// Measures all methods on a workload and writes the data of its pictures.
/// Collective over `comm`.
Comparison compare_methods(const Workload& workload, const Arguments& arguments,
                           const ResultsFolder& folder, MPI_Comm comm);

/// Returns true if a method failed in any comparison.
bool has_failures(std::span<const Comparison> comparisons);

/// Returns the text of table.csv; columns.md describes its columns.
std::string table_csv(std::span<const Comparison> comparisons);

/// Returns the text of calls.csv: the traffic of each method by MPI function, summed over the
/// ranks.
std::string calls_csv(std::span<const Comparison> comparisons);

/// Returns the text of call_times.csv, with the time of every call. Calls of the same turn may be
/// compared in pairs. The second call of zoltan-rcb in a turn is named "zoltan-rcb again".
std::string call_times_csv(std::span<const Comparison> comparisons);

}  // namespace comparisons
