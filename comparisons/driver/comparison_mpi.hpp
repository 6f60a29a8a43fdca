#pragma once

#include "arguments.hpp"
#include "measurement_mpi.hpp"
#include "noise.hpp"
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

/// A comparison on a workload, without measurements yet. Collective over `comm`.
Comparison describe(const Workload& workload, const MeasurementPlan& plan, MPI_Comm comm);

/// Measures all methods on a workload, prints their table and writes the data of its pictures.
/// Collective over `comm`.
Comparison compare_methods(const Workload& workload, const Arguments& arguments,
                           const ResultsFolder& folder, Progress& progress, MPI_Comm comm);

/// True when some method of some comparison failed.
bool has_failures(std::span<const Comparison> comparisons);

/// zoltan-rcb beside itself; none where it was not measured twice.
std::optional<Noise> noise_of(const Comparison& comparison);

/// What of a row of table.csv tells what was measured.
Row table_key(const Comparison& comparison, const std::string& method);

/// The rows of one comparison in table.csv, columns as README.md describes them.
std::vector<Row> table_rows(const Comparison& comparison);

/// A row of table.csv that was made of nothing.
Row table_columns();

/// table.csv.
std::string table_csv(std::span<const Comparison> comparisons);

/// calls.csv: what each method's call moved by MPI function, summed over the ranks.
std::string calls_csv(std::span<const Comparison> comparisons);

/// message_sizes.csv: what the library's messages are made of, for points of `dimension` axes.
std::string message_sizes_csv(int dimension);

/// table.csv for people, numbers they compare first.
void print_table(std::ostream& out, const Comparison& comparison);

}  // namespace comparisons
