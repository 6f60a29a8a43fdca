#include "simulation_table.hpp"

#include "text.hpp"

#include <rrcb/quality.hpp>

#include <thread>

namespace comparisons {

namespace {

std::string simulation_size(const SimulationPlan& plan, int num_ranks, std::int64_t num_points) {
    return std::to_string(num_ranks) + ',' + std::to_string(num_points) + ',' +
           std::to_string(plan.num_steps) + ',' + std::to_string(plan.every);
}

constexpr const char* run_columns =
    "wall_s,balance_s,step_s,mean_imbalance,worst_imbalance,front_x_m,moved_m,mass_kg,path_points,"
    "step_work_s,step_path_s,step_network_s,balance_work_s,balance_path_s,balance_network_s,";
constexpr std::size_t num_run_columns = 15;
constexpr std::size_t num_summary_columns = 15;

std::string number_or_nothing(const std::optional<double>& number) {
    return number ? write_number(*number) : "";
}

void write_cost(std::ostream& out, const PathCost& cost) {
    for (const double seconds : {cost.work_s, cost.path_s, cost.network_s}) {
        out << write_number(seconds) << ',';
    }
}

/// The fields of run_columns.
void write_run(std::ostream& out, const SimulationRun& run) {
    for (const double number :
         {run.wall_s, run.balance_s, run.step_s, run.mean_imbalance, run.worst_imbalance}) {
        out << write_number(number) << ',';
    }
    out << number_or_nothing(run.front_m) << ',';
    for (const double number : {run.moved_m, run.mass_kg, run.path_points}) {
        out << write_number(number) << ',';
    }
    write_cost(out, run.step_cost);
    write_cost(out, run.balance_cost);
}

void write_spread(std::ostream& out, const Spread& spread) {
    out << write_number(spread.median) << ',' << interval_fields(spread.interval95) << ',';
}

void write_summary(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                   const SimulationSummary& summary) {
    const SimulationRun& run = summary.middle;
    out << simulation_key(plan, num_ranks, run.num_points, run.method) << ',';
    if (!run.error.empty()) {
        out << std::string(num_run_columns + num_summary_columns, ',') << csv_field(run.error)
            << '\n';
        return;
    }
    write_run(out, run);
    out << summary.repeats << ',' << interval_fields(summary.wall_s.interval95) << ',';
    write_spread(out, summary.critical_path_s);
    if (summary.speed_up_critical_path) {
        write_spread(out, *summary.speed_up_critical_path);
    } else {
        out << ",,,";
    }
    out << number_or_nothing(summary.ideal_speed_up) << ',' << number_or_nothing(summary.gain_kept)
        << ',' << run.rebalances << ',' << write_number(run.moved_fraction) << ','
        << interval_fields(summary.mean_imbalance.interval95) << ",\n";
}

/// `part` / `whole` in percent, or - for nothing.
std::string percent(const std::optional<double>& share) {
    return share ? fixed(100 * *share, 1) : "-";
}

std::vector<std::string> printed_row(const SimulationSummary& summary,
                                     const SimulationSummary& first) {
    const SimulationRun& run = summary.middle;
    if (!run.error.empty()) return {run.method, run.error};
    const std::optional<Spread>& speed_up = summary.speed_up_critical_path;
    return {run.method,
            fixed(run.wall_s, 2),
            fixed(first.middle.wall_s / run.wall_s, 2),
            fixed(summary.critical_path_s.median, 3),
            speed_up ? fixed(speed_up->median, 2) : "-",
            percent(summary.gain_kept),
            fixed(run.mean_imbalance, 4),
            fixed(run.worst_imbalance, 4),
            fixed(100 * run.moved_fraction, 2),
            run.front_m ? fixed(*run.front_m, 2) : "-",
            fixed(run.moved_m, 3)};
}

}  // namespace

std::string simulation_key(const SimulationPlan& plan, int num_ranks, std::int64_t num_points,
                           const std::string& method) {
    return csv_field(method) + ',' + simulation_size(plan, num_ranks, num_points);
}

std::string simulation_header() {
    return std::string("method,ranks,points,steps,every,") + run_columns +
           "repeats,wall_s_low,wall_s_high,critical_path_s,critical_path_s_low,"
           "critical_path_s_high,speed_up_critical_path,speed_up_critical_path_low,"
           "speed_up_critical_path_high,ideal_speed_up,gain_kept,rebalances,moved_fraction,"
           "mean_imbalance_low,mean_imbalance_high,error";
}

void write_simulation(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                      const SimulationRun& run) {
    write_summary(out, plan, num_ranks, summarize({run.method, {run}}));
}

void write_simulations(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationSummary> summaries) {
    out << simulation_header() << '\n';
    for (const SimulationSummary& summary : summaries) {
        write_summary(out, plan, num_ranks, summary);
    }
}

void write_rounds(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                  std::span<const SimulationRounds> methods) {
    out << "method,round,seed,ranks,points,steps,every," << run_columns
        << "critical_path_s,rebalances,moved_fraction,error\n";
    for (const SimulationRounds& rounds : methods) {
        int round = 0;
        for (const SimulationRun& run : rounds.runs) {
            out << csv_field(rounds.method) << ',' << ++round << ','
                << (run.seed ? write_number(*run.seed) : "") << ','
                << simulation_size(plan, num_ranks, run.num_points) << ',';
            if (run.error.empty()) {
                write_run(out, run);
                out << write_number(critical_path_s(run)) << ',' << run.rebalances << ','
                    << write_number(run.moved_fraction) << ",\n";
            } else {
                out << std::string(num_run_columns + 3, ',') << csv_field(run.error) << '\n';
            }
        }
    }
}

void write_history(std::ostream& out, std::span<const SimulationRun> runs) {
    out << "method,step,time,part,points,lu_percent,imbalance,moved_fraction\n";
    for (const SimulationRun& run : runs) {
        for (const LoadRecord& record : run.history) {
            const std::vector<double> unbalance = rrcb::load_unbalance_percent(record.points);
            const double imbalance = rrcb::imbalance(record.points);
            for (std::size_t p = 0; p < record.points.size(); ++p) {
                out << csv_field(run.method) << ',' << record.step << ',' << record.time << ',' << p
                    << ',' << record.points[p] << ',' << unbalance[p] << ',' << imbalance << ','
                    << record.moved_fraction << '\n';
            }
        }
    }
}

void print_simulations(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationSummary> summaries) {
    out << "\nWhole simulation: " << summaries.front().middle.num_points << " points, " << num_ranks
        << " ranks, " << plan.num_steps << " steps, rebalanced every " << plan.every
        << ", median of " << summaries.front().repeats << "\n\n";
    std::vector<std::vector<std::string>> rows = {
        {"method", "wall s", "times as fast", "critical path s", "times as fast", "gain kept %",
         "mean imbalance", "worst imbalance", "moved %", "front at x, m", "moved, m"}};
    for (const SimulationSummary& summary : summaries) {
        rows.push_back(printed_row(summary, summaries.front()));
    }
    print_columns(out, rows);
    const int num_cores = static_cast<int>(std::thread::hardware_concurrency());
    if (num_cores > 0 && num_cores < num_ranks) {
        out << num_ranks << " ranks share " << num_cores
            << " cores: while one waits another works, so unbalance hardly costs time here.\n";
    }
}

}  // namespace comparisons
