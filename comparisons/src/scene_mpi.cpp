#include "scene_mpi.hpp"

#include "balancer_mpi.hpp"
#include "failure.hpp"
#include "scene_choice_mpi.hpp"
#include "simulation_table.hpp"

#include <iostream>
#include <memory>

namespace comparisons {

namespace {

/// A simulation to run: a label and the balancer, none for the run without.
struct Contender {
    std::string label;
    std::optional<mpm::Balancer> balancer;
};

std::vector<Contender> contenders(std::span<const Method> methods) {
    std::vector<Contender> all = {{"none", std::nullopt}};
    for (const Method& method : methods) {
        std::optional<mpm::Balancer> balancer = make_balancer(method);
        if (balancer) all.push_back({method.label, std::move(balancer)});
    }
    return all;
}

/// Thinned so that history.csv stays below 5 MB.
int record_interval(int num_steps, std::size_t num_runs, MPI_Comm comm) {
    constexpr double max_rows = 60'000;
    int num_parts = 0;
    MPI_Comm_size(comm, &num_parts);
    const double rows = static_cast<double>(num_runs) * num_parts * num_steps;
    return static_cast<int>(rows / max_rows) + 1;
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
        for (const auto& simulation : simulations) simulation->advance(turn);
    }
}

void print_and_write(const SimulationPlan& plan, std::span<const SimulationRun> runs,
                     const ResultsFolder& folder, MPI_Comm comm) {
    int rank = 0;
    int size = 0;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    if (rank == 0) print_simulations(std::cout, plan, size, runs);
    folder.write("simulation.csv",
                 [&](std::ostream& out) { write_simulations(out, plan, size, runs); });
    folder.write("history.csv", [&](std::ostream& out) { write_history(out, runs); });
}

}  // namespace

SimulationPlan plan_scene(const Arguments& arguments, std::size_t num_runs, MPI_Comm comm) {
    constexpr int quick_steps = 40;
    constexpr int default_every = 5;
    SimulationPlan plan{choose_scene(arguments.scene, arguments.quick, comm)};
    plan.num_steps = arguments.steps > 0 ? arguments.steps
                     : arguments.quick   ? quick_steps
                                         : steps_to_end(plan.scene, comm);
    plan.every = arguments.every > 0 ? arguments.every : default_every;
    plan.record_every = record_interval(plan.num_steps, num_runs, comm);
    return plan;
}

std::vector<std::string> snapshot_names(const mpm::Scene& scene) {
    return {scene.name + "-start", scene.name + "-middle", scene.name + "-end"};
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

SceneRuns run_scene(const Arguments& arguments, const ResultsFolder& folder, Progress& progress,
                    MPI_Comm comm) {
    const std::vector<Contender> all = contenders(arguments.methods);
    const SimulationPlan plan = plan_scene(arguments, all.size(), comm);
    SceneRuns scene;
    progress.start("simulations", static_cast<int>(all.size()) * plan.num_steps);
    const auto observe = [&](int steps_done, const mpm::Simulation&) {
        if (steps_done > 0) progress.advance();
    };
    const auto observe_slabs = [&](int steps_done, const mpm::Simulation& simulation) {
        observe(steps_done, simulation);
        take_snapshots(scene.snapshots, plan, steps_done, simulation);
    };
    std::vector<std::unique_ptr<TimedSimulation>> simulations;
    for (const Contender& contender : all) {
        const Observer observer = contender.balancer ? Observer(observe) : Observer(observe_slabs);
        simulations.push_back(
            std::make_unique<TimedSimulation>(plan, contender.balancer, observer, comm));
    }
    run_in_turns(simulations, plan.num_steps);
    for (std::size_t i = 0; i < all.size(); ++i) {
        scene.runs.push_back(simulations[i]->result());
        scene.runs.back().method = all[i].label;
    }
    print_and_write(plan, scene.runs, folder, comm);
    return scene;
}

}  // namespace comparisons
