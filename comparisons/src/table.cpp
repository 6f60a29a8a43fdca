#include "table.hpp"

#include "text.hpp"

#include <algorithm>

namespace comparisons {

namespace {

double median_of_zoltan_rcb(const Comparison& comparison) {
    for (const Measurement& measurement : comparison.measurements) {
        if (measurement.method == "zoltan-rcb") return median(measurement.times_ms);
    }
    return 0;
}

void write_result(std::ostream& out, const Measurement& measurement, double zoltan_rcb_ms) {
    const auto [min, max] = std::ranges::minmax(measurement.times_ms);
    const double middle = median(measurement.times_ms);
    out << middle << ',' << min << ',' << max << ',' << measurement.imbalance << ','
        << measurement.worst_unbalance_percent << ',' << measurement.traffic.messages << ','
        << measurement.traffic.bytes << ',' << measurement.traffic.root_bytes_in << ','
        << measurement.traffic.collectives << ',' << measurement.traffic.communicators << ','
        << measurement.moved_fraction << ',';
    if (zoltan_rcb_ms > 0) out << middle / zoltan_rcb_ms;
    out << ",\n";
}

using Row = std::vector<std::string>;

Row result_row(const Measurement& measurement, double zoltan_rcb_ms) {
    if (!measurement.error.empty()) return {measurement.method, measurement.error};
    const double middle = median(measurement.times_ms);
    return {measurement.method,
            fixed(measurement.imbalance, 5),
            fixed(measurement.worst_unbalance_percent, 3),
            fixed(middle, 2),
            zoltan_rcb_ms > 0 && middle > 0 ? fixed(zoltan_rcb_ms / middle, 2) : "-",
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
           "communicators,moved_fraction,time_vs_zoltan_rcb,error";
}

void write_rows(std::ostream& out, const Comparison& comparison) {
    const double zoltan_rcb_ms = median_of_zoltan_rcb(comparison);
    for (const Measurement& measurement : comparison.measurements) {
        out << row_key(comparison, measurement.method) << ',';
        if (measurement.error.empty()) {
            write_result(out, measurement, zoltan_rcb_ms);
        } else {
            out << std::string(12, ',') << csv_field(measurement.error) << '\n';
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
    std::vector<Row> rows = {{"method", "imbalance", "worst Lu %", "time ms", "times as fast",
                              "bytes", "messages", "into root", "moved %"}};
    const double zoltan_rcb_ms = median_of_zoltan_rcb(comparison);
    for (const Measurement& measurement : comparison.measurements) {
        rows.push_back(result_row(measurement, zoltan_rcb_ms));
    }
    print_columns(out, rows);
}

}  // namespace comparisons
