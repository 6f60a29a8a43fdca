#include "simulation_rounds.hpp"

#include "row.hpp"

#include <rrcb/quality.hpp>

namespace comparisons {

namespace {

void add_cost(Row& row, const std::string& phase, const PathCost& cost) {
    row.add(phase + "_work_s", cost.work_s)
        .add(phase + "_path_s", cost.path_s)
        .add(phase + "_network_s", cost.network_s);
}

/// `number` counts the rounds from 1 on.
Row round_row(const SimulationPlan& plan, int num_ranks, const std::string& method, int number,
              const SimulationRun& run) {
    Row row;
    row.add("method", method)
        .add("round", number)
        .add("seed", run.seed)
        .add("ranks", num_ranks)
        .add("points", run.num_points)
        .add("steps", plan.num_steps)
        .add("every", plan.every > 0 ? std::to_string(plan.every) : "auto")
        .end_key()
        .add("wall_s", run.wall_s)
        .add("balance_s", run.balance_s)
        .add("step_s", run.step_s)
        .add("mean_imbalance", run.mean_imbalance)
        .add("worst_imbalance", run.worst_imbalance)
        .add("front_x_m", run.front_m)
        .add("moved_m", run.moved_m)
        .add("mass_kg", run.mass_kg)
        .add("path_points", run.path_points);
    add_cost(row, "step", run.step_cost);
    add_cost(row, "balance", run.balance_cost);
    return row.add("critical_path_s", critical_path_s(run))
        .add("rebalances", run.rebalances)
        .add("moved_fraction", run.moved_fraction)
        .add_error(run.error)
        .add("scene", plan.scene.name);
}

Row history_row(const std::string& method, const LoadRecord& record, std::size_t part) {
    return Row()
        .add("method", method)
        .add("step", record.step)
        .add("time", nine_digits(record.time))
        .add("part", part)
        .add("points", nine_digits(record.points[part]))
        .add("lu_percent", nine_digits(rrcb::load_unbalance_percent(record.points)[part]))
        .add("imbalance", nine_digits(rrcb::imbalance(record.points)))
        .add("moved_fraction", nine_digits(record.moved_fraction));
}

}  // namespace

std::string rounds_csv(const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationRounds> methods) {
    std::vector<Row> rows;
    for (const SimulationRounds& rounds : methods) {
        int number = 0;
        for (const SimulationRun& run : rounds.runs)
            rows.push_back(round_row(plan, num_ranks, rounds.method, ++number, run));
    }
    return csv(round_row(plan, num_ranks, {}, 0, {}), rows);
}

std::string history_csv(std::span<const SimulationRounds> methods) {
    std::vector<Row> rows;
    for (const SimulationRounds& rounds : methods) {
        for (const LoadRecord& record : rounds.runs.front().history) {
            for (std::size_t part = 0; part < record.points.size(); ++part)
                rows.push_back(history_row(rounds.method, record, part));
        }
    }
    return csv(history_row({}, {.points = {1}}, 0), rows);
}

void print_round(std::ostream& out, int number, std::span<const SimulationRounds> methods) {
    std::vector<double> paths;
    for (const SimulationRounds& rounds : methods) {
        const SimulationRun& run = rounds.runs.back();
        if (rounds.has_failed())
            out << rounds.method << " failed: " << run.error << '\n';
        else
            paths.push_back(critical_path_s(run));
    }
    const auto [least, most] = range_of(paths);
    out << "Simulations, round " << number << ": critical paths of " << fixed(least, 3) << " to "
        << fixed(most, 3) << " s" << std::endl;
}

}  // namespace comparisons
