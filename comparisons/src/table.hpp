#pragma once

#include "measurement_mpi.hpp"
#include "noise.hpp"

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

/// True when some method of some comparison failed.
bool has_failures(std::span<const Comparison> comparisons);

/// zoltan-rcb beside itself; none where it was not measured twice.
std::optional<Noise> noise_of(const Comparison& comparison);

/// The fields a row of table.csv starts with, `method` to `repeats`: what was measured.
std::string row_key(const Comparison& comparison, const std::string& method);

/// Names of the columns of table.csv.
std::string table_header();

/// The rows of one comparison, in the columns of table_header.
void write_rows(std::ostream& out, const Comparison& comparison);

/// table.csv: one row per method and workload, columns as README.md describes them.
void write_table(std::ostream& out, std::span<const Comparison> comparisons);

/// calls.csv: what each method's call moved by MPI function, summed over the ranks.
void write_calls(std::ostream& out, std::span<const Comparison> comparisons);

/// The same for people, numbers they compare first.
void print_table(std::ostream& out, const Comparison& comparison);

}  // namespace comparisons
