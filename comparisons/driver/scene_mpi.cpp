#include "scene_mpi.hpp"

#include "failure_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "scene_choice_mpi.hpp"

#include <mpm/slope.hpp>

#include <algorithm>
#include <iostream>
#include <memory>

namespace comparisons {

namespace {

/// Rounds of simulations at most: the fewest whose smallest and largest value make an interval.
constexpr int max_rounds = 6;

/// What is simulated in every round; without a method nothing is rebalanced.
struct Contender {
    std::string label;
    std::optional<Method> method;
};

std::vector<Contender> contenders(std::span<const Method> methods) {
    std::vector<Contender> all = {{"none", std::nullopt}};
    for (const Method& method : methods) {
        if (make_balancer(method)) all.push_back({method.label, method});
    }
    all.push_back({"none again", std::nullopt});
    return all;
}

/// Thinned so that history.csv stays below 5 MB; odd, so that a load that alternates shows.
int record_interval(int num_steps, std::size_t num_runs, MPI_Comm comm) {
    constexpr double max_rows = 60'000;
    const int num_parts = size_of(comm);
    const double rows = static_cast<double>(num_runs) * num_parts * num_steps;
    return (static_cast<int>(rows / max_rows) + 1) | 1;
}

void take_snapshots(std::vector<Workload>& snapshots, const SimulationPlan& plan, int steps_done,
                    const mpm::Simulation& simulation) {
    const std::vector<std::string> names = snapshot_names(plan.scene);
    for (int i = 0; i < static_cast<int>(names.size()); ++i) {
        if (steps_done == plan.num_steps * i / 2) {
            snapshots.push_back(snapshot(names[static_cast<std::size_t>(i)], simulation));
        }
    }
}

/// Turns are long enough that each simulation finds its points in the cache again.
void run_in_turns(std::span<const std::unique_ptr<TimedSimulation>> simulations, int num_steps) {
    constexpr int turn = 50;
    for (int done = 0; done < num_steps; done += turn) {
        for (const auto& simulation : simulations) {
            if (simulation) simulation->advance(turn);
        }
    }
}

/// The simulations of all contenders, round by round; those of one round at a time are kept.
class SceneRounds {
  public:
    SceneRounds(const SimulationPlan& plan, std::vector<Contender> all, Progress& progress,
                MPI_Comm comm)
        : plan_(plan), all_(std::move(all)), progress_(progress), comm_(comm) {
        for (const Contender& contender : all_) rounds_.push_back({contender.label, {}});
    }

    /// One simulation of each contender that has not failed yet. Collective.
    void run(int round);

    std::vector<SimulationRounds> rounds() && { return std::move(rounds_); }
    /// Of the first simulation of the first round.
    const std::vector<Workload>& snapshots() const { return snapshots_; }

  private:
    std::unique_ptr<TimedSimulation> start(std::size_t contender, int round);
    void take_result(std::size_t contender, int round, SimulationRun run);

    const SimulationPlan& plan_;
    std::vector<Contender> all_;
    Progress& progress_;
    MPI_Comm comm_;
    std::vector<SimulationRounds> rounds_;
    std::vector<Workload> snapshots_;
};

void SceneRounds::run(int round) {
    progress_.start("simulations, round " + std::to_string(round + 1),
                    static_cast<int>(all_.size()) * plan_.num_steps);
    std::vector<std::unique_ptr<TimedSimulation>> simulations;
    for (std::size_t i = 0; i < all_.size(); ++i) {
        simulations.push_back(rounds_[i].has_failed() ? nullptr : start(i, round));
    }
    run_in_turns(simulations, plan_.num_steps);
    for (std::size_t i = 0; i < all_.size(); ++i) {
        if (simulations[i]) take_result(i, round, simulations[i]->result());
    }
    if (rank_of(comm_) == 0) print_round(std::cout, round + 1, rounds_);
}

std::unique_ptr<TimedSimulation> SceneRounds::start(std::size_t contender, int round) {
    const bool shows_the_scene = contender == 0 && round == 0;
    const auto observe = [this, shows_the_scene](int steps_done,
                                                 const mpm::Simulation& simulation) {
        if (steps_done > 0) progress_.advance();
        if (shows_the_scene) take_snapshots(snapshots_, plan_, steps_done, simulation);
    };
    const std::optional<Method>& method = all_[contender].method;
    std::optional<mpm::Balancer> balancer;
    if (method) balancer = make_balancer(with_next_seed(*method, static_cast<unsigned>(round)));
    return std::make_unique<TimedSimulation>(plan_, std::move(balancer), observe, comm_);
}

void SceneRounds::take_result(std::size_t contender, int round, SimulationRun run) {
    const std::optional<Method>& method = all_[contender].method;
    run.method = all_[contender].label;
    if (method && varies_with_seed(*method)) {
        run.seed = method->seed() + static_cast<unsigned>(round);
    }
    if (round > 0) run.history.clear();
    rounds_[contender].runs.push_back(std::move(run));
}

/// Steps until the front of the slope lies still, within 0.2 m of where it ends.
int steps_of_failure(MPI_Comm comm) {
    constexpr double end_of_failure_s = 5.5;
    mpm::Scene scene = mpm::slope_scene();
    scene.end_time = end_of_failure_s;
    return steps_to_end(scene, comm);
}

}  // namespace

SimulationPlan plan_scene(const Arguments& arguments, std::size_t num_runs, MPI_Comm comm) {
    constexpr int quick_steps = 40;
    SimulationPlan plan{choose_scene(arguments.scene, arguments.quick, comm)};
    plan.num_steps = arguments.steps > 0 ? arguments.steps
                     : arguments.quick   ? quick_steps
                                         : steps_to_end(plan.scene, comm);
    plan.every = arguments.every;
    plan.record_every = record_interval(plan.num_steps, num_runs, comm);
    return plan;
}

std::vector<std::string> snapshot_names(const mpm::Scene& scene) {
    return {scene.name + "-start", scene.name + "-middle", scene.name + "-end"};
}

Workload snapshot(const std::string& name, const mpm::Simulation& simulation) {
    Workload workload;
    workload.name = name;
    workload.layout = "simulation";
    const mpm::Positions positions = simulation.positions();
    workload.dimension = positions.z.empty() ? 2 : 3;
    workload.coordinates = interleaved(positions);
    return workload;
}

std::vector<Workload> scene_snapshots(const SimulationPlan& plan, Progress& progress,
                                      MPI_Comm comm) {
    std::vector<Workload> snapshots;
    progress.start("the " + plan.scene.name, plan.num_steps);
    const auto observe = [&](int steps_done, const mpm::Simulation& simulation) {
        if (steps_done > 0) progress.advance();
        take_snapshots(snapshots, plan, steps_done, simulation);
    };
    TimedSimulation simulation(plan, std::nullopt, observe, comm);
    simulation.advance(plan.num_steps);
    const std::string error = simulation.result().error;
    if (!error.empty()) throw Failure(plan.scene.name + ": " + error);
    return snapshots;
}

std::vector<SimulationRounds> run_scene(const Arguments& arguments, const ResultsFolder& folder,
                                        Progress& progress, const SnapshotVisitor& visit,
                                        MPI_Comm comm) {
    std::vector<Contender> all = contenders(arguments.methods);
    SimulationPlan plan = plan_scene(arguments, all.size() - 1, comm);
    const bool is_main_job = arguments.scene == "slope" && arguments.only == Only::all;
    if (is_main_job && arguments.steps == 0 && !arguments.quick)
        plan.num_steps = steps_of_failure(comm);
    const int num_rounds = arguments.only == Only::simulations
                               ? arguments.repeats
                               : std::min(arguments.repeats, max_rounds);
    SceneRounds rounds(plan, std::move(all), progress, comm);
    rounds.run(0);
    visit(rounds.snapshots());
    for (int round = 1; round < num_rounds; ++round) rounds.run(round);
    std::vector<SimulationRounds> methods = std::move(rounds).rounds();
    const std::span<const SimulationRounds> once(methods.data(), methods.size() - 1);
    folder.write("simulation_runs.csv", [&] { return rounds_csv(plan, size_of(comm), methods); });
    folder.write("history.csv", [&] { return history_csv(once); });
    return methods;
}

}  // namespace comparisons
