#include "scene_mpi.hpp"

#include "core_rota_mpi.hpp"
#include "counter_random.hpp"
#include "failure_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "progress.hpp"
#include "row.hpp"
#include "scene_choice_mpi.hpp"

#include <rrcb/paper.hpp>
#include <rrcb/quality.hpp>

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>

namespace comparisons {

namespace {

/// Steps of a simulation in its turn; most of them find their points in the cache.
constexpr int turn = 50;

/// The largest number of rounds of simulations. The range of six values is a 95 % confidence
/// interval.
constexpr int max_rounds = 6;

std::string interval_text(int every) {
    return every > 0 ? std::to_string(every) : "auto";
}

/// Returns the contenders that rebalance every `every` steps.
std::vector<SimulationRounds> contenders(const Arguments& arguments, int every) {
    std::vector<SimulationRounds> all;
    for (const Method& method : arguments.methods)
        if (make_balancer(method)) all.push_back({method.label, {}, method, Cost::count, every});
    if (arguments.cost == Cost::learned) {
        const Method method = read_method("rrcb-arrays");
        all.push_back({"count", {}, method, Cost::count, every});
        all.push_back({"learned", {}, method, Cost::learned, every});
        all.push_back({"known", {}, method, Cost::known, every});
    }
    if (arguments.every.size() > 1)
        for (SimulationRounds& rounds : all) rounds.method += " every " + interval_text(every);
    return all;
}

/// Returns one contender for each simulated method and interval, and first one without rebalancing.
/// The second contender is also added a second time. The difference between these two is noise.
std::vector<SimulationRounds> contenders(const Arguments& arguments) {
    const SimulationRounds none{"none", {}, {}, Cost::count, arguments.every.front()};
    std::vector<SimulationRounds> all(1, none);
    for (const int every : arguments.every)
        std::ranges::move(contenders(arguments, every), std::back_inserter(all));
    if (arguments.serial)
        all.push_back({"serial", {}, {}, Cost::count, arguments.every.front(), true});
    all.push_back(all[all.size() > 1 ? 1 : 0]);
    all.back().method += " again";
    return all;
}

/// Returns the interval of records that keeps history.csv below 5 MB. It is odd, so that a load
/// that alternates between steps remains visible.
int record_interval(int num_steps, std::size_t num_runs, MPI_Comm comm) {
    constexpr double max_rows = 60'000;
    const int num_parts = size_of(comm);
    const double rows = static_cast<double>(num_runs) * num_parts * num_steps;
    return (static_cast<int>(rows / max_rows) + 1) | 1;
}

/// Returns the current points of a simulation as a workload with this name.
Workload snapshot(const std::string& name, const mpm::Simulation& simulation) {
    Workload workload;
    workload.name = name;
    workload.layout = "simulation";
    const mpm::Positions positions = simulation.positions();
    workload.dimension = positions.dimension;
    workload.coordinates.reserve(static_cast<std::size_t>(workload.dimension) * positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const mpm::Vector at = positions[i];
        workload.coordinates.insert(workload.coordinates.end(), at.begin(),
                                    at.begin() + workload.dimension);
    }
    return workload;
}

/// Returns an observer that takes the snapshots of the scene.
Observer taking_snapshots(const SimulationPlan& plan, std::vector<Workload>& snapshots) {
    return [&plan, &snapshots](int steps_done, const mpm::Simulation& simulation) {
        for (int i = 0; i < 3; ++i)
            if (steps_done == plan.num_steps * i / 2)
                snapshots.push_back(snapshot(
                    plan.scene.name + std::array{"-start", "-middle", "-end"}[i], simulation));
    };
}

/// Tells all ranks that a simulation on rank 0 has failed. Collective.
void share_failure(SimulationRun& run, MPI_Comm comm) {
    bool has_failed = !run.error.empty();
    MPI_Bcast(&has_failed, 1, MPI_CXX_BOOL, 0, comm);
    if (has_failed && rank_of(comm) != 0) run.error = "it failed on rank 0";
}

/// Runs one simulation of each contender that has not failed. The snapshots are those of the first
/// contender in the first round.
void run_round(std::vector<SimulationRounds>& all, int round, const SimulationPlan& plan,
               std::vector<Workload>& snapshots, MPI_Comm comm) {
    std::vector<SimulationPlan> plans(all.size(), plan);
    std::vector<std::unique_ptr<TimedSimulation>> simulations(all.size());
    const std::uint64_t seed = seed_for("round " + std::to_string(round), plan.seed);
    // The order is random, because the place of a simulation in memory depends on those created
    // before it.
    for (const std::size_t next : drawn_order(all.size(), seed, 0)) {
        const SimulationRounds& rounds = all[next];
        const bool shows_the_scene = round == 0 && next == 0;
        const auto make = [&](const PointWeights& weights) -> std::optional<mpm::Balancer> {
            if (!rounds.balanced_by) return std::nullopt;
            return make_balancer(with_next_seed(*rounds.balanced_by, static_cast<unsigned>(round)),
                                 weights);
        };
        plans[next].every = rounds.every;
        const bool differs = rounds.balanced_by && varies_with_seed(*rounds.balanced_by);
        if (!rounds.has_failed() && (!rounds.is_serial || rank_of(comm) == 0))
            simulations[next] = std::make_unique<TimedSimulation>(
                plans[next], make, shows_the_scene ? taking_snapshots(plan, snapshots) : Observer(),
                rounds.is_serial ? MPI_COMM_SELF : comm, rounds.cost,
                round == 0 || differs ? nullptr : &rounds.runs.back());
    }
    const CoreRota cores(comm);
    Progress progress(plan.progress && rank_of(comm) == 0,
                      "round " + std::to_string(round + 1) + ", steps", plan.num_steps);
    for (int done = 0; done < plan.num_steps; done += turn) {
        cores.bind(round + done / turn);
        const auto number = static_cast<std::uint64_t>(done / turn);
        for (const std::size_t next : drawn_order(all.size(), seed, number))
            if (simulations[next]) simulations[next]->advance(turn);
        progress.advance(std::min(turn, plan.num_steps - done));
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].has_failed()) continue;
        SimulationRun run;  // a result may read the runs of earlier rounds
        if (simulations[i]) run = simulations[i]->result();
        if (all[i].is_serial) share_failure(run, comm);
        const std::optional<Method>& method = all[i].balanced_by;
        if (method && varies_with_seed(*method))
            run.seed = method->seed() + static_cast<unsigned>(round);
        if (round > 0) run.history.clear();
        all[i].runs.push_back(std::move(run));
    }
}

/// Writes the state of a scene after some steps without rebalancing. Returns the file. Collective.
std::string state_after(int num_steps, const SimulationPlan& plan, const std::string& folder,
                        MPI_Comm comm) {
    mpm::Simulation simulation(plan.scene, comm);
    for (int step = 0; step < num_steps; ++step) simulation.step();
    const std::string file = folder + "/state.mpm";
    simulation.write_state(file);
    return file;
}

/// Returns the steps until the front of the slope stops, within 0.2 m of its final position.
int steps_of_failure(MPI_Comm comm) {
    constexpr double end_of_failure_s = 6.5;
    mpm::Scene scene = choose_scene("slope", false, comm);
    scene.end_time = end_of_failure_s;
    return steps_to_end(scene, comm);
}

void add_work(Row& row, const std::string& name, const StepWork& work) {
    row.add(name, work.all).add(name + "_path", work.path);
}

void add_cost(Row& row, const std::string& phase, const PathCost& cost) {
    row.add(phase + "_work_s", cost.work_s)
        .add(phase + "_path_s", cost.path_s)
        .add(phase + "_root_s", cost.root_s)
        .add(phase + "_network_s", cost.network_s)
        .add(phase + "_messages", cost.messages)
        .add(phase + "_bytes", cost.bytes);
}

/// Returns the row of a round. The first round has the number 1.
Row round_row(const SimulationPlan& plan, int num_ranks, const SimulationRounds& rounds, int number,
              const SimulationRun& run) {
    Row row;
    row.add("method", rounds.method)
        .add("round", number)
        .add("seed", run.seed)
        .add("ranks", rounds.is_serial ? 1 : num_ranks)
        .add("points", run.num_points)
        .add("steps", plan.num_steps)
        .add("every", interval_text(rounds.every))
        .add("scene", plan.scene.name)
        .end_key(run.error)
        .add("wall_s", run.wall_s)
        .add("balance_s", run.balance_s)
        .add("decide_s", run.decide_s)
        .add("step_s", run.step_s)
        .add("mean_imbalance", run.mean_imbalance)
        .add("worst_imbalance", run.worst_imbalance)
        .add("front_x_m", run.front_m)
        .add("moved_m", run.moved_m)
        .add("mass_kg", run.mass_kg)
        .add("path_points", run.path_points);
    add_cost(row, "step", run.step_cost);
    add_cost(row, "balance", run.balance_cost);
    add_cost(row, "decide", run.decide_cost);
    add_work(row, "counted", run.counted);
    add_work(row, "counted_at_rest", run.counted_at_rest);
    add_work(row, "least_s", run.least_s);
    add_work(row, "least_at_rest_s", run.least_at_rest_s);
    return row.add("critical_path_s", critical_path_s(run))
        .add("rebalances", run.rebalances)
        .add("moved_fraction", run.moved_fraction)
        .add_error();
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
        .add("moved_fraction", nine_digits(record.moved_fraction))
        .add("runs", record.columns[1][part])
        .add("nodes", record.columns[2][part])
        .add("shared_nodes", record.columns[3][part])
        .add("work", nine_digits(record.columns[4][part]));
}

/// Returns the text of history.csv: the load of every part at the recorded steps of the first
/// round.
std::string history_csv(std::span<const SimulationRounds> methods) {
    std::vector<Row> rows;
    for (const SimulationRounds& rounds : methods) {
        for (const LoadRecord& record : rounds.runs.front().history) {
            for (std::size_t part = 0; part < record.points.size(); ++part)
                rows.push_back(history_row(rounds.method, record, part));
        }
    }
    return csv(history_row({}, {.points = {1}, .columns = {5, std::vector<double>(1)}}, 0), rows);
}

}  // namespace

SimulationPlan plan_scene(const Arguments& arguments, std::size_t num_runs, MPI_Comm comm) {
    constexpr int quick_steps = 40;
    SimulationPlan plan{choose_scene(arguments.scene, arguments.quick, comm)};
    plan.num_steps = arguments.steps > 0 ? arguments.steps
                     : arguments.quick   ? quick_steps
                     : arguments.scene == "slope" && arguments.only != Only::simulations
                         ? steps_of_failure(comm)
                         : steps_to_end(plan.scene, comm);
    plan.record_every = arguments.record_every > 0
                            ? arguments.record_every
                            : record_interval(plan.num_steps, num_runs, comm);
    plan.seed = arguments.seed;
    plan.progress = arguments.progress;
    plan.unit_costs = unit_costs(arguments.scene);
    return plan;
}

std::vector<Workload> scene_snapshots(const SimulationPlan& plan, MPI_Comm comm) {
    std::vector<Workload> snapshots;
    TimedSimulation simulation(plan, without_weights({}), taking_snapshots(plan, snapshots), comm);
    Progress progress(plan.progress && rank_of(comm) == 0, plan.scene.name + ", steps",
                      plan.num_steps);
    for (int done = 0; done < plan.num_steps; done += turn) {
        simulation.advance(turn);
        progress.advance(std::min(turn, plan.num_steps - done));
    }
    const std::string error = simulation.result().error;
    if (!error.empty()) throw Failure(plan.scene.name + ": " + error);
    return snapshots;
}

std::vector<SimulationRounds> run_scene(const Arguments& arguments, const ResultsFolder& folder,
                                        const SnapshotVisitor& visit, MPI_Comm comm) {
    std::vector<SimulationRounds> all = contenders(arguments);
    SimulationPlan plan = plan_scene(arguments, all.size() - 1, comm);
    if (arguments.from > 0) plan.state = state_after(arguments.from, plan, arguments.out, comm);
    const int num_rounds = arguments.only == Only::simulations
                               ? arguments.repeats
                               : std::min(arguments.repeats, max_rounds);
    std::vector<Workload> snapshots;
    RoundsDone done{0, num_rounds, 0};
    for (int round = 0; round < num_rounds; ++round) {
        const double start = MPI_Wtime();
        run_round(all, round, plan, snapshots, comm);
        done.elapsed_s += MPI_Wtime() - start;
        ++done.number;
        if (rank_of(comm) == 0) print_round(std::cout, done, all);
        if (round == 0) visit(snapshots);
    }
    const std::span<const SimulationRounds> once(all.data(), all.size() - 1);
    folder.write("simulation_runs.csv", [&] { return rounds_csv(plan, size_of(comm), all); });
    folder.write("history.csv", [&] { return history_csv(once); });
    return all;
}

std::string rounds_csv(const SimulationPlan& plan, int num_ranks,
                       std::span<const SimulationRounds> methods) {
    std::vector<Row> rows;
    for (const SimulationRounds& rounds : methods) {
        int number = 0;
        for (const SimulationRun& run : rounds.runs)
            rows.push_back(round_row(plan, num_ranks, rounds, ++number, run));
    }
    return csv(round_row(plan, num_ranks, {}, 0, {}), rows);
}

void print_round(std::ostream& out, const RoundsDone& done,
                 std::span<const SimulationRounds> methods) {
    std::vector<double> paths;
    for (const SimulationRounds& rounds : methods) {
        const SimulationRun& run = rounds.runs.back();
        if (rounds.has_failed())
            out << rounds.method << " failed: " << run.error << '\n';
        else
            paths.push_back(critical_path_s(run));
    }
    const auto [least, most] = range_of(paths);
    out << "Round " << done.number << " of " << done.of
        << ": with a core for every rank a simulation takes " << fixed(least, 3) << " to "
        << fixed(most, 3) << " s";
    if (done.number < done.of)
        out << "; about " << fixed(done.elapsed_s / done.number * (done.of - done.number), 0)
            << " s left";
    out << std::endl;
}

}  // namespace comparisons
