#include "simulation_table.hpp"

#include "text.hpp"

#include <rrcb/quality.hpp>

#include <thread>

namespace comparisons {

namespace {

void write_cost(std::ostream& out, const PathCost& cost) {
    out << ',' << cost.work_s << ',' << cost.path_s << ',' << cost.network_s;
}

}  // namespace

std::string simulation_key(const SimulationPlan& plan, int num_ranks, std::int64_t num_points,
                           const std::string& method) {
    return csv_field(method) + ',' + std::to_string(num_ranks) + ',' + std::to_string(num_points) +
           ',' + std::to_string(plan.num_steps) + ',' + std::to_string(plan.every);
}

std::string simulation_header() {
    return "method,ranks,points,steps,every,wall_s,balance_s,step_s,mean_imbalance,"
           "worst_imbalance,front_x_m,moved_m,mass_kg,path_points,step_work_s,step_path_s,"
           "step_network_s,balance_work_s,balance_path_s,balance_network_s,error";
}

void write_simulation(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                      const SimulationRun& run) {
    out << simulation_key(plan, num_ranks, run.num_points, run.method) << ',';
    if (run.error.empty()) {
        out << run.wall_s << ',' << run.balance_s << ',' << run.step_s << ',' << run.mean_imbalance
            << ',' << run.worst_imbalance << ',' << (run.front_m ? write_number(*run.front_m) : "")
            << ',' << run.moved_m << ',' << run.mass_kg << ',' << write_number(run.path_points);
        write_cost(out, run.step_cost);
        write_cost(out, run.balance_cost);
        out << ",\n";
    } else {
        out << std::string(15, ',') << csv_field(run.error) << '\n';
    }
}

void write_simulations(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationRun> runs) {
    out << simulation_header() << '\n';
    for (const SimulationRun& run : runs) write_simulation(out, plan, num_ranks, run);
}

void write_history(std::ostream& out, std::span<const SimulationRun> runs) {
    out << "method,step,time,part,points,lu_percent,imbalance\n";
    for (const SimulationRun& run : runs) {
        for (const LoadRecord& record : run.history) {
            const std::vector<double> unbalance = rrcb::load_unbalance_percent(record.points);
            const double imbalance = rrcb::imbalance(record.points);
            for (std::size_t p = 0; p < record.points.size(); ++p) {
                out << csv_field(run.method) << ',' << record.step << ',' << record.time << ',' << p
                    << ',' << record.points[p] << ',' << unbalance[p] << ',' << imbalance << '\n';
            }
        }
    }
}

void print_simulations(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationRun> runs) {
    out << "\nWhole simulation: " << runs.front().num_points << " points, " << num_ranks
        << " ranks, " << plan.num_steps << " steps, rebalanced every " << plan.every << "\n\n";
    std::vector<std::vector<std::string>> rows = {{"method", "wall s", "times as fast", "balance s",
                                                   "step s", "mean imbalance", "worst imbalance",
                                                   "front at x, m", "moved, m"}};
    for (const SimulationRun& run : runs) {
        if (!run.error.empty()) {
            rows.push_back({run.method, run.error});
            continue;
        }
        rows.push_back({run.method, fixed(run.wall_s, 2),
                        fixed(runs.front().wall_s / run.wall_s, 2), fixed(run.balance_s, 2),
                        fixed(run.step_s, 2), fixed(run.mean_imbalance, 4),
                        fixed(run.worst_imbalance, 4), run.front_m ? fixed(*run.front_m, 2) : "-",
                        fixed(run.moved_m, 3)});
    }
    print_columns(out, rows);
    const int num_cores = static_cast<int>(std::thread::hardware_concurrency());
    if (num_cores > 0 && num_cores < num_ranks) {
        out << num_ranks << " ranks share " << num_cores
            << " cores: while one waits another works, so unbalance hardly costs time here.\n";
    }
}

}  // namespace comparisons
