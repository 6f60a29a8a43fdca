#pragma once

#include "arguments.hpp"
#include "measurement_mpi.hpp"
#include "results_folder_mpi.hpp"

#include <mpi.h>

#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace comparisons {

/// All methods on one workload.
struct Comparison {
    std::string workload;
    std::string layout;
    int dimension = 2;
    rrcb::GlobalCount num_points = 0;
    int num_ranks = 1;
    MeasurementPlan plan;
    std::vector<Measurement> measurements;
    std::vector<double> second_times_ms = {};  ///< of zoltan-rcb, measured once more in every turn
};

/// Measures all methods on a workload, prints their table and writes the data of its pictures.
/// Collective over `comm`.
Comparison compare_methods(const Workload& workload, const Arguments& arguments,
                           const ResultsFolder& folder, Progress& progress, MPI_Comm comm);

/// True when some method of some comparison failed.
bool has_failures(std::span<const Comparison> comparisons);

/// table.csv, columns as columns.md describes them.
std::string table_csv(std::span<const Comparison> comparisons);

/// calls.csv: what each method's call moved by MPI function, summed over the ranks.
std::string calls_csv(std::span<const Comparison> comparisons);

/// call_times.csv: every timed call; those of one turn may be compared in pairs. The second of
/// zoltan-rcb in a turn is named "zoltan-rcb again".
std::string call_times_csv(std::span<const Comparison> comparisons);

/// table.csv for people, numbers they compare first.
void print_table(std::ostream& out, const Comparison& comparison);

}  // namespace comparisons
