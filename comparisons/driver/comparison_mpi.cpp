#include "comparison_mpi.hpp"

#include "failure_mpi.hpp"
#include "plot_data_mpi.hpp"
#include "row.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

namespace comparisons {

namespace {

/// Returns the times of zoltan-rcb; empty if it was not measured or failed.
std::vector<double> reference_times(const Comparison& comparison) {
    const auto& all = comparison.measurements;
    const auto found = std::ranges::find(all, "zoltan-rcb", &Measurement::method);
    return found == all.end() || !found->error.empty() ? std::vector<double>() : found->times_ms;
}

/// Returns the range of the values of the seeds. A single value is a range of its own.
std::optional<Interval> interval_of_seeds(const std::vector<double>& values) {
    if (values.size() == 1) return Interval{values.front(), values.front()};
    return interval95(values);
}

std::optional<double> ratio_of(double time, double reference) {
    return reference > 0 ? std::optional(time / reference) : std::nullopt;
}

Row table_row(const Comparison& comparison, const Measurement& measurement) {
    const std::vector<double>& times = measurement.times_ms;
    const std::vector<double> reference_ms = reference_times(comparison);
    const Traffic& traffic = measurement.traffic;
    const Ghosts& ghosts = measurement.ghosts;
    return Row()
        .add("method", measurement.method)
        .add("ranks", comparison.num_ranks)
        .add("parts", comparison.num_ranks)
        .add("points", comparison.num_points)
        .add("dim", comparison.dimension)
        .add("workload", comparison.workload)
        .add("layout", comparison.layout)
        .add("lists", lists_name(comparison.plan.lists))
        .add("repeats", comparison.plan.repeats)
        .end_key(measurement.error)
        .add("time_ms_median", median(times))
        .add("time_ms_min", range_of(times).low)
        .add("time_ms_max", range_of(times).high)
        .add("imbalance", median(measurement.imbalances))
        .add("lu_max_percent", std::abs(measurement.worst_unbalance_percent))
        .add("messages", traffic.messages)
        .add("bytes", traffic.bytes)
        .add("root_bytes_in", traffic.root_bytes_in)
        .add("collectives", traffic.collectives)
        .add("communicators", traffic.communicators)
        .add("moved_fraction", measurement.moved_fraction)
        .add("time_vs_zoltan_rcb", ratio_of(median(times), median(reference_ms)))
        .add_interval("time_ms_", interval95(times))
        .add_interval("time_vs_zoltan_rcb_", interval95(paired_ratios(times, reference_ms)))
        .add_interval("imbalance_", interval_of_seeds(measurement.imbalances))
        .add("seeds", measurement.imbalances.size())
        .add("lu_worst_percent", measurement.worst_unbalance_percent)
        .add("rounds", measurement.rounds)
        .add_error()
        .add("ghosts", ghosts.sum)
        .add("ghosts_max", ghosts.most)
        .add("neighbours_max", ghosts.most_neighbours)
        .add("off_machine_ghosts", ghosts.off_machine);
}

/// Returns the first columns of a row about a method's calls.
Row call_key(const Comparison& comparison, const std::string& method) {
    return Row()
        .add("method", method)
        .add("ranks", comparison.num_ranks)
        .add("workload", comparison.workload)
        .add("layout", comparison.layout);
}

Row calls_row(const Comparison& comparison, const std::string& method, const std::string& function,
              const CallCount& count) {
    return call_key(comparison, method)
        .add("function", function)
        .add("calls", count.calls)
        .add("bytes_in", count.bytes_in)
        .add("bytes_out", count.bytes_out);
}

Row time_row(const Comparison& comparison, const std::string& method, std::size_t turn,
             double time_ms) {
    return call_key(comparison, method).add("turn", turn).add("time_ms", time_ms);
}

/// Returns a description of the comparison, still without measurements. Collective over `comm`.
Comparison describe(const Workload& workload, const MeasurementPlan& plan, MPI_Comm comm) {
    Comparison comparison{
        workload.name, workload.layout, workload.dimension, 0, size_of(comm), plan, {}};
    const auto count = static_cast<rrcb::GlobalCount>(workload.points().count);
    MPI_Allreduce(&count, &comparison.num_points, 1, MPI_INT64_T, MPI_SUM, comm);
    return comparison;
}

}  // namespace

Comparison compare_methods(const Workload& workload, const Arguments& arguments,
                           const ResultsFolder& folder, MPI_Comm comm) {
    Comparison comparison = describe(workload, arguments, comm);
    std::vector<Method> methods = arguments.methods;
    const auto reference = std::ranges::find(methods, "zoltan-rcb", &Method::label);
    const bool is_twice = reference != methods.end();
    if (is_twice) methods.push_back(Method(*reference));
    comparison.measurements = measure(workload, methods, comparison.plan, comm);
    if (is_twice) {
        comparison.second_times_ms = std::move(comparison.measurements.back().times_ms);
        comparison.measurements.pop_back();
    }
    if (arguments.data)
        write_plot_data(folder, workload, arguments.methods, comparison.measurements, comm);
    double radius = 0;
    for (const Measurement& m : comparison.measurements) radius = std::max(radius, m.ghosts.radius);
    if (rank_of(comm) == 0)
        std::cout << workload.name << ": " << comparison.num_points << " points, ghosts within "
                  << nine_digits(radius) << std::endl;
    return comparison;
}

bool has_failures(std::span<const Comparison> comparisons) {
    return std::ranges::any_of(comparisons, [](const Comparison& comparison) {
        return std::ranges::any_of(comparison.measurements,
                                   [](const Measurement& m) { return !m.error.empty(); });
    });
}

std::string table_csv(std::span<const Comparison> comparisons) {
    std::vector<Row> rows;
    for (const Comparison& comparison : comparisons)
        for (const Measurement& measurement : comparison.measurements)
            rows.push_back(table_row(comparison, measurement));
    return csv(table_row({}, {}), rows);
}

std::string calls_csv(std::span<const Comparison> comparisons) {
    std::vector<Row> rows;
    for (const Comparison& comparison : comparisons) {
        for (const Measurement& measurement : comparison.measurements) {
            for (const auto& [function, count] : measurement.calls) {
                rows.push_back(calls_row(comparison, measurement.method, function, count));
            }
        }
    }
    return csv(calls_row({}, {}, {}, {}), rows);
}

std::string call_times_csv(std::span<const Comparison> comparisons) {
    std::vector<Row> rows;
    for (const Comparison& comparison : comparisons) {
        const auto add = [&](const std::string& method, const std::vector<double>& times_ms) {
            std::size_t turn = 0;
            for (const double time_ms : times_ms)
                rows.push_back(time_row(comparison, method, ++turn, time_ms));
        };
        for (const Measurement& measurement : comparison.measurements)
            add(measurement.method, measurement.times_ms);
        add("zoltan-rcb again", comparison.second_times_ms);
    }
    return csv(time_row({}, {}, 0, 0), rows);
}

}  // namespace comparisons
