#include "sweep_mpi.hpp"

#include "balancer_mpi.hpp"
#include "comparison_mpi.hpp"
#include "saved_rows_mpi.hpp"
#include "scene_mpi.hpp"
#include "simulation_table.hpp"
#include "sweep_settings.hpp"
#include "table.hpp"
#include "workload_mpi.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <thread>

namespace comparisons {

namespace {

/// What all parts of a sweep work with.
struct Sweep {
    const Arguments& arguments;
    const ResultsFolder& folder;
    Progress& progress;
    MPI_Comm comm;
    int rank = 0;
    int num_ranks = 1;

    void say(const std::string& line) const {
        if (rank == 0) std::cout << line << std::endl;
    }
};

/// Measures the settings that have no row yet, Zoltan's RCB always among them for comparison.
bool measure_missing(const Sweep& sweep, const Workload& workload, std::vector<Method> settings,
                     SavedRows& rows) {
    Comparison comparison =
        describe(workload, {sweep.arguments.lists, sweep.arguments.repeats}, sweep.comm);
    std::erase_if(settings,
                  [&](const Method& m) { return rows.has(row_key(comparison, m.label)); });
    sweep.say(workload.name + ", " + std::to_string(workload.dimension) + "-D, " + workload.layout +
              ": " + std::to_string(settings.size()) + " settings to measure");
    if (settings.empty()) return true;
    const Method reference = read_method("zoltan-rcb");
    if (std::ranges::find(settings, reference.label, &Method::label) == settings.end()) {
        settings.insert(settings.begin(), reference);
    }
    comparison.measurements =
        measure(workload, settings, comparison.plan, sweep.progress, sweep.comm);
    return !rows.add([&](std::ostream& out) { write_rows(out, comparison); });
}

bool sweep_clouds(const Sweep& sweep, SavedRows& rows) {
    bool succeeded = true;
    for (const std::string name : {"slope", "clusters", "lattice", "uniform"}) {
        for (const int dimension : {2, 3}) {
            for (const Layout layout : {Layout::sorted, Layout::scattered}) {
                const Workload workload =
                    cloud_workload({name, sweep.arguments.points, dimension, sweep.arguments.seed},
                                   layout, sweep.comm);
                succeeded =
                    measure_missing(sweep, workload, sweep.arguments.methods, rows) && succeeded;
            }
        }
    }
    return succeeded;
}

/// The paper's settings beside the methods they are judged by.
std::vector<Method> study_settings(bool quick) {
    std::vector<Method> settings = read_methods("zoltan-rcb,root-rcb,rrcb,rrcb-exact");
    for (Method& method : paper_settings(quick)) settings.push_back(std::move(method));
    return settings;
}

/// Whether every setting has its row for every snapshot, told without running the slope.
bool has_snapshots(const Sweep& sweep, const SimulationPlan& plan, const SavedRows& rows) {
    Comparison expected{"", "simulation", 2, 0, sweep.num_ranks, {}, {}};
    expected.num_points = mpm::Simulation(plan.scene, sweep.comm).num_points();
    expected.plan = {sweep.arguments.lists, sweep.arguments.repeats};
    const std::vector<Method> settings = study_settings(sweep.arguments.quick);
    return std::ranges::all_of(snapshot_names(), [&](const std::string& name) {
        expected.workload = name;
        return std::ranges::all_of(settings, [&](const Method& method) {
            return rows.has(row_key(expected, method.label));
        });
    });
}

/// Of the whole failure, whatever the number of steps to be timed.
bool study_snapshots(const Sweep& sweep, SavedRows& rows) {
    Arguments whole = sweep.arguments;
    whole.steps = 0;
    const SimulationPlan plan = plan_scene(whole, 1, sweep.comm);
    if (has_snapshots(sweep, plan, rows)) return true;
    bool succeeded = true;
    for (const Workload& workload : slope_snapshots(plan, sweep.progress, sweep.comm)) {
        succeeded = measure_missing(sweep, workload, study_settings(sweep.arguments.quick), rows) &&
                    succeeded;
    }
    return succeeded;
}

/// Short, unless asked otherwise, for there are many; rebalanced at every step, as the paper does.
SimulationPlan study_plan(const Sweep& sweep) {
    constexpr int default_steps = 50;
    constexpr int quick_steps = 5;
    Arguments arguments = sweep.arguments;
    if (arguments.steps == 0) arguments.steps = arguments.quick ? quick_steps : default_steps;
    if (arguments.every == 0) arguments.every = 1;
    return plan_scene(arguments, 1, sweep.comm);
}

SimulationRun simulate(const SimulationPlan& plan, const std::string& label,
                       const std::optional<mpm::Balancer>& balancer, Progress& progress,
                       MPI_Comm comm) {
    progress.start(label, plan.num_steps);
    const Observer observe = [&](int steps_done, const mpm::Simulation&) {
        if (steps_done > 0) progress.advance();
    };
    TimedSimulation simulation(plan, balancer, observe, comm);
    simulation.advance(plan.num_steps);
    SimulationRun run = simulation.result();
    run.method = label;
    return run;
}

/// The simulation on rank 0 alone. The others sleep: ranks that wait in MPI keep a core busy.
SimulationRun simulate_serially(const Sweep& sweep, const SimulationPlan& plan) {
    SimulationRun run;
    if (sweep.rank == 0) {
        run = simulate(plan, "serial", std::nullopt, sweep.progress, MPI_COMM_SELF);
    }
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(sweep.comm, &request);
    for (int done = 0; done == 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return run;
}

bool study_simulations(const Sweep& sweep) {
    SavedRows rows(sweep.folder, "sweep_simulation.csv", simulation_header(), 5);
    const SimulationPlan plan = study_plan(sweep);
    const std::int64_t num_points = mpm::Simulation(plan.scene, sweep.comm).num_points();
    const auto missing = [&](const std::string& label, int num_ranks) {
        return !rows.has(simulation_key(plan, num_ranks, num_points, label));
    };
    const auto add = [&](const SimulationRun& run, int num_ranks) {
        return !rows.add([&](std::ostream& out) { write_simulation(out, plan, num_ranks, run); });
    };
    sweep.say("simulations of " + std::to_string(plan.num_steps) + " steps");
    bool succeeded = true;
    if (missing("serial", 1)) succeeded = add(simulate_serially(sweep, plan), 1);
    if (missing("none", sweep.num_ranks)) {
        succeeded = add(simulate(plan, "none", std::nullopt, sweep.progress, sweep.comm),
                        sweep.num_ranks) &&
                    succeeded;
    }
    for (const Method& method : study_settings(sweep.arguments.quick)) {
        if (!missing(method.label, sweep.num_ranks)) continue;
        const SimulationRun run =
            simulate(plan, method.label, make_balancer(method), sweep.progress, sweep.comm);
        succeeded = add(run, sweep.num_ranks) && succeeded;
    }
    return succeeded;
}

}  // namespace

bool run_sweep(const Arguments& arguments, const ResultsFolder& folder, Progress& progress,
               MPI_Comm comm) {
    Sweep sweep{arguments, folder, progress, comm};
    MPI_Comm_rank(comm, &sweep.rank);
    MPI_Comm_size(comm, &sweep.num_ranks);
    SavedRows rows(folder, "sweep.csv", table_header(), 9);
    const bool clouds = sweep_clouds(sweep, rows);
    const bool snapshots = study_snapshots(sweep, rows);
    const bool simulations = study_simulations(sweep);
    return clouds && snapshots && simulations;
}

}  // namespace comparisons
