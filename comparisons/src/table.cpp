#include "table.hpp"

#include "text.hpp"

#include <algorithm>
#include <cmath>

namespace comparisons {

namespace {

/// Times of zoltan-rcb; none when it was not measured or failed.
std::vector<double> reference_times(const Comparison& comparison) {
    for (const Measurement& measurement : comparison.measurements) {
        if (measurement.method == "zoltan-rcb" && measurement.error.empty()) {
            return measurement.times_ms;
        }
    }
    return {};
}

/// A single value is that of all seeds.
std::optional<Interval> interval_of_seeds(const std::vector<double>& values) {
    if (values.size() == 1) return Interval{values.front(), values.front()};
    return interval95(values);
}

void write_intervals(std::ostream& out, const Measurement& measurement,
                     const std::vector<double>& reference_ms) {
    const std::vector<double> ratios = paired_ratios(measurement.times_ms, reference_ms);
    out << ',' << interval_fields(interval95(measurement.times_ms)) << ','
        << interval_fields(interval95(ratios)) << ','
        << interval_fields(interval_of_seeds(measurement.imbalances)) << ','
        << measurement.imbalances.size() << ','
        << write_number(measurement.worst_unbalance_percent);
}

void write_result(std::ostream& out, const Measurement& measurement,
                  const std::vector<double>& reference_ms) {
    const auto [min, max] = std::ranges::minmax(measurement.times_ms);
    const double middle = median(measurement.times_ms);
    // To all digits: whether a part holds one point too many shows in the last ones.
    for (const double number : {middle, min, max, median(measurement.imbalances),
                                std::abs(measurement.worst_unbalance_percent)}) {
        out << write_number(number) << ',';
    }
    out << measurement.traffic.messages << ',' << measurement.traffic.bytes << ','
        << measurement.traffic.root_bytes_in << ',' << measurement.traffic.collectives << ','
        << measurement.traffic.communicators << ',' << write_number(measurement.moved_fraction)
        << ',';
    const double reference = median(reference_ms);
    if (reference > 0) out << write_number(middle / reference);
    write_intervals(out, measurement, reference_ms);
    out << ",\n";
}

using Row = std::vector<std::string>;

Row result_row(const Measurement& measurement, double reference_ms) {
    if (!measurement.error.empty()) return {measurement.method, measurement.error};
    const double middle = median(measurement.times_ms);
    const std::optional<Interval> interval = interval95(measurement.times_ms);
    return {measurement.method,
            fixed(median(measurement.imbalances), 5),
            fixed(measurement.worst_unbalance_percent, 3),
            fixed(middle, 2),
            interval ? fixed(interval->low, 2) + " ... " + fixed(interval->high, 2) : "-",
            reference_ms > 0 && middle > 0 ? fixed(reference_ms / middle, 2) : "-",
            human_bytes(static_cast<double>(measurement.traffic.bytes)),
            std::to_string(measurement.traffic.messages),
            human_bytes(static_cast<double>(measurement.traffic.root_bytes_in)),
            fixed(100 * measurement.moved_fraction, 1)};
}

}  // namespace

bool has_failures(std::span<const Comparison> comparisons) {
    return std::ranges::any_of(comparisons, [](const Comparison& comparison) {
        return std::ranges::any_of(comparison.measurements,
                                   [](const Measurement& m) { return !m.error.empty(); });
    });
}

std::optional<Noise> noise_of(const Comparison& comparison) {
    const std::vector<double> ratios =
        paired_ratios(comparison.second_times_ms, reference_times(comparison));
    if (ratios.empty()) return std::nullopt;
    return Noise{comparison.workload, "zoltan-rcb", spread_of(ratios)};
}

std::string row_key(const Comparison& comparison, const std::string& method) {
    const std::string ranks = std::to_string(comparison.num_ranks);
    return csv_field(method) + ',' + ranks + ',' + ranks + ',' +
           std::to_string(comparison.num_points) + ',' + std::to_string(comparison.dimension) +
           ',' + csv_field(comparison.workload) + ',' + comparison.layout + ',' +
           lists_name(comparison.plan.lists) + ',' + std::to_string(comparison.plan.repeats);
}

std::string table_header() {
    return "method,ranks,parts,points,dim,workload,layout,lists,repeats,time_ms_median,time_ms_min,"
           "time_ms_max,imbalance,lu_max_percent,messages,bytes,root_bytes_in,collectives,"
           "communicators,moved_fraction,time_vs_zoltan_rcb,time_ms_low,time_ms_high,"
           "time_vs_zoltan_rcb_low,time_vs_zoltan_rcb_high,imbalance_low,imbalance_high,seeds,"
           "lu_worst_percent,error";
}

void write_rows(std::ostream& out, const Comparison& comparison) {
    const std::vector<double> reference_ms = reference_times(comparison);
    for (const Measurement& measurement : comparison.measurements) {
        out << row_key(comparison, measurement.method) << ',';
        if (measurement.error.empty()) {
            write_result(out, measurement, reference_ms);
        } else {
            out << std::string(20, ',') << csv_field(measurement.error) << '\n';
        }
    }
}

void write_table(std::ostream& out, std::span<const Comparison> comparisons) {
    out << table_header() << '\n';
    for (const Comparison& comparison : comparisons) write_rows(out, comparison);
}

void write_calls(std::ostream& out, std::span<const Comparison> comparisons) {
    out << "method,ranks,workload,layout,function,calls,bytes_in,bytes_out\n";
    for (const Comparison& comparison : comparisons) {
        for (const Measurement& measurement : comparison.measurements) {
            for (const auto& [function, count] : measurement.calls) {
                out << csv_field(measurement.method) << ',' << comparison.num_ranks << ','
                    << csv_field(comparison.workload) << ',' << comparison.layout << ',' << function
                    << ',' << count.calls << ',' << count.bytes_in << ',' << count.bytes_out
                    << '\n';
            }
        }
    }
}

void print_table(std::ostream& out, const Comparison& comparison) {
    out << '\n'
        << comparison.workload << ": " << comparison.num_points << " points, "
        << comparison.dimension << "-D, " << comparison.layout << ", " << comparison.num_ranks
        << " ranks, lists " << lists_name(comparison.plan.lists) << ", median of "
        << comparison.plan.repeats << "\n\n";
    std::vector<Row> rows = {{"method", "imbalance", "Lu of largest size %", "time ms", "95 %",
                              "times as fast", "bytes", "messages", "into root", "moved %"}};
    const double reference_ms = median(reference_times(comparison));
    for (const Measurement& measurement : comparison.measurements) {
        rows.push_back(result_row(measurement, reference_ms));
    }
    print_columns(out, rows);
}

}  // namespace comparisons
