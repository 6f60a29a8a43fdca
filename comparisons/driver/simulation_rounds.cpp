#include "simulation_rounds.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <thread>

namespace comparisons {

namespace {

using Field = double (*)(const SimulationRun&);

std::vector<double> values(const SimulationRounds& rounds, Field field) {
    std::vector<double> result;
    for (const SimulationRun& run : rounds.runs) result.push_back(field(run));
    return result;
}

double wall_s(const SimulationRun& run) {
    return run.wall_s;
}

bool has_failed(const SimulationRounds& rounds) {
    return !rounds.runs.back().error.empty();
}

/// Medians of `member` of all runs.
template <typename Object>
void take_median(Object& result, double Object::*member, const std::vector<Object>& objects) {
    std::vector<double> found;
    for (const Object& object : objects) found.push_back(object.*member);
    result.*member = median(std::move(found));
}

PathCost middle_cost(const SimulationRounds& rounds, PathCost SimulationRun::*cost) {
    std::vector<PathCost> costs;
    for (const SimulationRun& run : rounds.runs) costs.push_back(run.*cost);
    PathCost middle;
    for (const auto member : {&PathCost::work_s, &PathCost::path_s, &PathCost::network_s}) {
        take_median(middle, member, costs);
    }
    return middle;
}

std::optional<double> middle_front(const SimulationRounds& rounds) {
    std::vector<double> fronts;
    for (const SimulationRun& run : rounds.runs) {
        if (run.front_m) fronts.push_back(*run.front_m);
    }
    return fronts.empty() ? std::nullopt : std::optional(median(std::move(fronts)));
}

SimulationRun middle_run(const SimulationRounds& rounds) {
    SimulationRun middle = has_failed(rounds) ? rounds.runs.back() : rounds.runs.front();
    middle.method = rounds.method;
    middle.history.clear();
    if (has_failed(rounds)) return middle;
    for (const auto member :
         {&SimulationRun::wall_s, &SimulationRun::balance_s, &SimulationRun::step_s,
          &SimulationRun::mean_imbalance, &SimulationRun::worst_imbalance,
          &SimulationRun::moved_fraction, &SimulationRun::moved_m, &SimulationRun::mass_kg,
          &SimulationRun::path_points}) {
        take_median(middle, member, rounds.runs);
    }
    middle.rebalances = static_cast<int>(
        median(values(rounds, [](const SimulationRun& run) -> double { return run.rebalances; })));
    middle.step_cost = middle_cost(rounds, &SimulationRun::step_cost);
    middle.balance_cost = middle_cost(rounds, &SimulationRun::balance_cost);
    middle.front_m = middle_front(rounds);
    return middle;
}

/// Rounds of one seed that agree to the last bit have nothing random about them.
Spread spread_of_imbalance(const SimulationRounds& rounds) {
    const std::vector<double> means =
        values(rounds, [](const SimulationRun& run) { return run.mean_imbalance; });
    Spread spread = spread_of(means);
    const auto [low, high] = std::ranges::minmax(means);
    const bool is_fixed = means.size() > 1 && !rounds.runs.front().seed && low == high;
    if (is_fixed) spread.interval95 = Interval{low, high};
    return spread;
}

double median_of(const SimulationRounds& rounds, Field field) {
    return median(values(rounds, field));
}

/// The shortest path of the steps alone under any method that did not fail.
double shortest_steps(std::span<const SimulationRounds> methods) {
    double shortest = median_of(methods.front(), steps_path_s);
    for (const SimulationRounds& rounds : methods) {
        if (!has_failed(rounds)) shortest = std::min(shortest, median_of(rounds, steps_path_s));
    }
    return shortest;
}

std::string interval(const SimulationPlan& plan) {
    return plan.every > 0 ? std::to_string(plan.every) : "auto";
}

void add_size(Row& row, const SimulationPlan& plan, int num_ranks, std::int64_t num_points) {
    row.add("ranks", num_ranks)
        .add("points", num_points)
        .add("steps", plan.num_steps)
        .add("every", interval(plan))
        .end_key();
}

void add_cost(Row& row, const std::string& phase, const PathCost& cost) {
    row.add(phase + "_work_s", cost.work_s)
        .add(phase + "_path_s", cost.path_s)
        .add(phase + "_network_s", cost.network_s);
}

/// What a single run and a summary have in common.
void add_run(Row& row, const SimulationRun& run) {
    row.add("wall_s", run.wall_s)
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
}

/// `number` counts the rounds from 1 on.
Row round_row(const SimulationPlan& plan, int num_ranks, const std::string& method, int number,
              const SimulationRun& run) {
    Row row;
    row.add("method", method).add("round", number).add("seed", run.seed);
    add_size(row, plan, num_ranks, run.num_points);
    add_run(row, run);
    return row.add("critical_path_s", critical_path_s(run))
        .add("rebalances", run.rebalances)
        .add("moved_fraction", run.moved_fraction)
        .add_error(run.error);
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

Row printed_row(const SimulationSummary& summary) {
    const SimulationRun& run = summary.middle;
    Row row;
    row.add("method", run.method);
    if (!run.error.empty()) return row.add_error(run.error);
    const std::optional<Spread>& speed_up = summary.speed_up_critical_path;
    return row.add("wall s", fixed(run.wall_s, 2))
        .add("critical path s", fixed(summary.critical_path_s.median, 3))
        .add("times as fast", speed_up ? fixed(speed_up->median, 2) : "-")
        .add("imbalance", fixed(run.mean_imbalance, 4))
        .add("moved %", fixed(100 * run.moved_fraction, 2));
}

}  // namespace

SimulationSummary summarize(const SimulationRounds& rounds) {
    SimulationSummary summary;
    summary.middle = middle_run(rounds);
    summary.repeats = static_cast<int>(rounds.runs.size());
    if (has_failed(rounds)) return summary;
    summary.wall_s = spread_of(values(rounds, wall_s));
    summary.critical_path_s = spread_of(values(rounds, critical_path_s));
    summary.mean_imbalance = spread_of_imbalance(rounds);
    return summary;
}

std::vector<SimulationSummary> summarize_all(std::span<const SimulationRounds> methods) {
    std::vector<SimulationSummary> summaries;
    for (const SimulationRounds& rounds : methods) summaries.push_back(summarize(rounds));
    const SimulationRounds& none = methods.front();
    if (has_failed(none)) return summaries;
    const double none_s = median_of(none, critical_path_s);
    const double shortest_s = shortest_steps(methods);
    for (std::size_t m = 0; m < methods.size(); ++m) {
        if (has_failed(methods[m])) continue;
        const std::vector<double> speed_ups =
            paired_ratios(values(none, critical_path_s), values(methods[m], critical_path_s));
        if (!speed_ups.empty()) summaries[m].speed_up_critical_path = spread_of(speed_ups);
        if (shortest_s > 0) summaries[m].ideal_speed_up = none_s / shortest_s;
        if (none_s > shortest_s) {
            summaries[m].gain_kept =
                (none_s - summaries[m].critical_path_s.median) / (none_s - shortest_s);
        }
    }
    return summaries;
}

std::vector<Noise> noise_of(const std::string& scene, const SimulationRounds& none,
                            const SimulationRounds& again) {
    std::vector<Noise> noise;
    if (has_failed(none) || has_failed(again)) return noise;
    const auto add = [&](const char* what, Field field) {
        const std::vector<double> ratios = paired_ratios(values(again, field), values(none, field));
        if (!ratios.empty()) noise.push_back({scene, what, spread_of(ratios)});
    };
    add("none", wall_s);
    add("none critical path", critical_path_s);
    return noise;
}

Row simulation_row(const SimulationPlan& plan, int num_ranks, const SimulationSummary& summary) {
    const SimulationRun& run = summary.middle;
    Row row;
    row.add("method", run.method);
    add_size(row, plan, num_ranks, run.num_points);
    add_run(row, run);
    return row.add("repeats", summary.repeats)
        .add_interval("wall_s_", summary.wall_s.interval95)
        .add_spread("critical_path_s", summary.critical_path_s)
        .add_spread("speed_up_critical_path", summary.speed_up_critical_path)
        .add("ideal_speed_up", summary.ideal_speed_up)
        .add("gain_kept", summary.gain_kept)
        .add("rebalances", run.rebalances)
        .add("moved_fraction", run.moved_fraction)
        .add_interval("mean_imbalance_", summary.mean_imbalance.interval95)
        .add_error(run.error);
}

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

std::string history_csv(std::span<const SimulationRun> runs) {
    std::vector<Row> rows;
    for (const SimulationRun& run : runs) {
        for (const LoadRecord& record : run.history) {
            for (std::size_t part = 0; part < record.points.size(); ++part)
                rows.push_back(history_row(run.method, record, part));
        }
    }
    return csv(history_row({}, {.points = {1}}, 0), rows);
}

void print_simulations(std::ostream& out, const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationSummary> summaries) {
    out << "\nWhole simulation: " << summaries.front().middle.num_points << " points, " << num_ranks
        << " ranks, " << plan.num_steps << " steps, rebalanced "
        << (plan.every > 0 ? "every " + interval(plan) : "when it pays") << ", median of "
        << summaries.front().repeats << "\n\n";
    std::vector<Row> rows;
    for (const SimulationSummary& summary : summaries) {
        rows.push_back(printed_row(summary));
    }
    print_columns(out, printed_row({}), rows);
    const int num_cores = static_cast<int>(std::thread::hardware_concurrency());
    if (num_cores > 0 && num_cores < num_ranks) {
        out << num_ranks << " ranks share " << num_cores
            << " cores: while one waits another works, so unbalance hardly costs time here.\n";
    }
}

}  // namespace comparisons
