#include "simulation_rounds.hpp"

#include <algorithm>

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

}  // namespace comparisons
