#include "paper_study_mpi.hpp"

#include "balancer_mpi.hpp"
#include "scene_mpi.hpp"
#include "simulation_table.hpp"
#include "sweep_settings.hpp"
#include "table.hpp"
#include "text.hpp"

#include <mpm/slope.hpp>

#include <algorithm>
#include <chrono>
#include <thread>

namespace comparisons {

namespace {

/// Whether every setting has its row for every snapshot, told without running the slope.
bool has_snapshots(const Sweep& sweep, const SimulationPlan& plan, const SavedRows& rows) {
    Comparison expected{"", "simulation", 2, 0, sweep.num_ranks, {}, {}};
    expected.num_points = mpm::Simulation(plan.scene, sweep.comm).num_points();
    expected.plan = {sweep.arguments.lists, sweep.arguments.repeats};
    const std::vector<Method> settings = study_settings(sweep.arguments.quick);
    return std::ranges::all_of(snapshot_names(plan.scene), [&](const std::string& name) {
        expected.workload = name;
        return std::ranges::all_of(settings, [&](const Method& method) {
            return rows.has(row_key(expected, method.label));
        });
    });
}

/// Steps until the front of the slope lies still, within 0.2 m of where it ends.
int steps_of_failure(MPI_Comm comm) {
    constexpr double end_of_failure_s = 5.5;
    mpm::Scene scene = mpm::slope_scene();
    scene.end_time = end_of_failure_s;
    return steps_to_end(scene, comm);
}

/// The failure, unless asked otherwise, with about a hundred records of the load.
SimulationPlan study_plan(const Sweep& sweep) {
    constexpr int default_every = 20;
    constexpr int quick_steps = 5;
    constexpr int num_records = 100;
    Arguments arguments = sweep.arguments;
    if (arguments.steps == 0)
        arguments.steps = arguments.quick ? quick_steps : steps_of_failure(sweep.comm);
    if (arguments.every == 0) arguments.every = arguments.quick ? 1 : default_every;
    SimulationPlan plan = plan_scene(arguments, 1, sweep.comm);
    plan.record_every = std::max(1, plan.num_steps / num_records);
    return plan;
}

/// Simulations that have no row yet.
class Study {
  public:
    explicit Study(const Sweep& sweep)
        : sweep_(sweep),
          plan_(study_plan(sweep)),
          num_points_(mpm::Simulation(plan_.scene, sweep.comm).num_points()),
          rows_(sweep.folder, "sweep_simulation.csv", simulation_header(), 5) {}

    /// Beside the serial simulation and the one without rebalancing; true when none failed.
    bool run(const std::vector<Method>& settings);

  private:
    bool is_missing(const std::string& label, int num_ranks) const {
        return !rows_.has(simulation_key(plan_, num_ranks, num_points_, label));
    }
    SimulationRun simulate(const std::string& label, const std::optional<mpm::Balancer>& balancer,
                           MPI_Comm comm);
    SimulationRun simulate_serially();
    bool add(const SimulationRun& run, int num_ranks);

    const Sweep& sweep_;
    SimulationPlan plan_;
    std::int64_t num_points_;
    SavedRows rows_;
    std::size_t num_settings_ = 0;
    std::size_t num_started_ = 0;
};

SimulationRun Study::simulate(const std::string& label,
                              const std::optional<mpm::Balancer>& balancer, MPI_Comm comm) {
    sweep_.progress.start(
        std::to_string(++num_started_) + "/" + std::to_string(num_settings_) + " " + label,
        plan_.num_steps);
    const Observer observe = [&](int steps_done, const mpm::Simulation&) {
        if (steps_done > 0) sweep_.progress.advance();
    };
    TimedSimulation simulation(plan_, balancer, observe, comm);
    simulation.advance(plan_.num_steps);
    SimulationRun run = simulation.result();
    run.method = label;
    return run;
}

/// On rank 0 alone. The others sleep: ranks that wait in MPI keep a core busy.
SimulationRun Study::simulate_serially() {
    SimulationRun run;
    if (sweep_.rank == 0) run = simulate("serial", std::nullopt, MPI_COMM_SELF);
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(sweep_.comm, &request);
    for (int done = 0; done == 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return run;
}

bool Study::add(const SimulationRun& run, int num_ranks) {
    const std::string method =
        sweep_.folder.from_root([&](std::ostream& out) { out << run.method; });
    sweep_.folder.write(
        "data/history_" + file_name_part(method) + "_" + std::to_string(num_ranks) + ".csv",
        [&](std::ostream& out) { write_history(out, std::span(&run, 1)); });
    return !rows_.add([&](std::ostream& out) { write_simulation(out, plan_, num_ranks, run); });
}

bool Study::run(const std::vector<Method>& settings) {
    num_settings_ = settings.size() + 2;
    sweep_.say("simulations of " + std::to_string(plan_.num_steps) + " steps, " +
               std::to_string(sweep_.num_ranks) + " ranks: up to " + std::to_string(num_settings_));
    bool succeeded = true;
    if (is_missing("serial", 1)) succeeded = add(simulate_serially(), 1);
    if (is_missing("none", sweep_.num_ranks)) {
        const SimulationRun run = simulate("none", std::nullopt, sweep_.comm);
        succeeded = add(run, sweep_.num_ranks) && succeeded;
    }
    for (const Method& method : settings) {
        if (!is_missing(method.label, sweep_.num_ranks)) continue;
        const SimulationRun run = simulate(method.label, make_balancer(method), sweep_.comm);
        succeeded = add(run, sweep_.num_ranks) && succeeded;
    }
    return succeeded;
}

}  // namespace

bool study_snapshots(const Sweep& sweep, SavedRows& rows) {
    // Of the whole failure, whatever the number of steps to be timed.
    Arguments whole = sweep.arguments;
    whole.steps = 0;
    const SimulationPlan plan = plan_scene(whole, 1, sweep.comm);
    if (has_snapshots(sweep, plan, rows)) return true;
    bool succeeded = true;
    for (const Workload& workload : scene_snapshots(plan, sweep.progress, sweep.comm)) {
        succeeded = measure_missing(sweep, workload, study_settings(sweep.arguments.quick), rows) &&
                    succeeded;
    }
    return succeeded;
}

bool study_simulations(const Sweep& sweep) {
    return Study(sweep).run(study_settings(sweep.arguments.quick));
}

bool study_ranks(const Sweep& sweep) {
    return Study(sweep).run(standard_settings());
}

}  // namespace comparisons
