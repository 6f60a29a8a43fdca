#include "comparison_mpi.hpp"
#include "cycle_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "plot_data_mpi.hpp"
#include "scene_mpi.hpp"
#include "sweep_mpi.hpp"
#include "sweep_settings.hpp"

#include <rrcb/balance.hpp>

#include <mpm/slope.hpp>

#include <algorithm>
#include <chrono>
#include <thread>

namespace comparisons {

namespace {

/// The settings of the study, and the paper's rule of a cut taken literally.
std::vector<Method> snapshot_settings(bool quick) {
    std::vector<Method> settings = study_settings(quick);
    settings.push_back(read_method("root-rcb[cut=midpoint]"));
    return settings;
}

/// Whether every setting has its row for every snapshot, told without running the slope.
bool has_snapshots(const Sweep& sweep, const SimulationPlan& plan, const SavedRows& rows) {
    Comparison expected{"", "simulation", 2, 0, sweep.num_ranks, {}, {}};
    expected.num_points = mpm::Simulation(plan.scene, sweep.comm).num_points();
    expected.plan = {sweep.arguments.lists, sweep.arguments.repeats};
    const std::vector<Method> settings = snapshot_settings(sweep.arguments.quick);
    return std::ranges::all_of(snapshot_names(plan.scene), [&](const std::string& name) {
        expected.workload = name;
        return std::ranges::all_of(settings, [&](const Method& method) {
            return rows.has(table_key(expected, method.label));
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

/// The same rebalanced at every step, as the paper does. Every step is recorded: at every other one
/// only half of a load that alternates would show.
SimulationPlan paper_plan(const Sweep& sweep) {
    SimulationPlan plan = study_plan(sweep);
    plan.every = 1;
    plan.record_every = 1;
    return plan;
}

/// Simulations that have no row yet.
class Study {
  public:
    /// Rows go to `file`, loads to data/<histories>_<method>_<ranks>.csv.
    Study(const Sweep& sweep, SimulationPlan plan, const std::string& file, std::string histories)
        : sweep_(sweep),
          plan_(std::move(plan)),
          histories_(std::move(histories)),
          num_points_(mpm::Simulation(plan_.scene, sweep.comm).num_points()),
          rows_(sweep.folder, file,
                Row().add("repeat", 0).add(simulation_row(plan_, sweep.num_ranks, {}))) {}

    /// `num_repeats` rounds of the serial simulation, the one without rebalancing and the
    /// settings; a method that draws points takes another seed in each. True when none failed.
    bool run(const std::vector<Method>& settings, int num_repeats);

  private:
    bool is_missing(int repeat, const std::string& label, int num_ranks) const {
        return !rows_.has(
            Row().add("repeat", repeat).add(simulation_key(plan_, num_ranks, num_points_, label)));
    }
    bool run_round(const std::vector<Method>& settings, int repeat);
    SimulationRun simulate(const std::string& label, const std::optional<mpm::Balancer>& balancer,
                           MPI_Comm comm);
    SimulationRun simulate_serially();
    bool add(int repeat, const SimulationRun& run, int num_ranks);

    const Sweep& sweep_;
    SimulationPlan plan_;
    std::string histories_;
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

/// The history is that of the first repeat.
bool Study::add(int repeat, const SimulationRun& run, int num_ranks) {
    if (repeat == 1) {
        const std::string method = sweep_.folder.from_root([&] { return run.method; });
        sweep_.folder.write("data/" + histories_ + '_' + file_name_part(method) + '_' +
                                std::to_string(num_ranks) + ".csv",
                            [&] { return history_csv(std::span(&run, 1)); });
    }
    const Row row = simulation_row(plan_, num_ranks, summarize({run.method, {run}}));
    return rows_.add({Row().add("repeat", repeat).add(row)});
}

bool Study::run_round(const std::vector<Method>& settings, int repeat) {
    bool succeeded = true;
    if (is_missing(repeat, "serial", 1)) succeeded = add(repeat, simulate_serially(), 1);
    if (is_missing(repeat, "none", sweep_.num_ranks)) {
        const SimulationRun run = simulate("none", std::nullopt, sweep_.comm);
        succeeded = add(repeat, run, sweep_.num_ranks) && succeeded;
    }
    for (const Method& method : settings) {
        if (!is_missing(repeat, method.label, sweep_.num_ranks)) continue;
        const Method seeded = with_next_seed(method, static_cast<unsigned>(repeat) - 1);
        const SimulationRun run = simulate(method.label, make_balancer(seeded), sweep_.comm);
        succeeded = add(repeat, run, sweep_.num_ranks) && succeeded;
    }
    return succeeded;
}

bool Study::run(const std::vector<Method>& settings, int num_repeats) {
    num_settings_ = (settings.size() + 2) * static_cast<std::size_t>(num_repeats);
    num_started_ = 0;
    sweep_.say("simulations of " + std::to_string(plan_.num_steps) + " steps, rebalanced every " +
               std::to_string(plan_.every) + ", " + std::to_string(sweep_.num_ranks) +
               " ranks: up to " + std::to_string(num_settings_));
    const double start = MPI_Wtime();
    bool succeeded = true;
    for (int repeat = 1; repeat <= num_repeats; ++repeat) {
        succeeded = run_round(settings, repeat) && succeeded;
    }
    sweep_.say("they took " + fixed((MPI_Wtime() - start) / 60, 1) + " minutes");
    return succeeded;
}

/// Figure 2 of the paper: the statistical domain of the slope's start in six boxes.
void write_six_boxes(const Sweep& sweep) {
    Workload start = start_of_slope(sweep);
    start.name = "six-boxes";
    const Method method = read_method("rrcb-sampled");
    Measurement measurement;
    measurement.method = method.label;
    measurement.parts = rrcb::balance(start.points(), *method.options, sweep.comm).parts;
    write_plot_data(sweep.folder, start, std::span(&method, 1), std::span(&measurement, 1),
                    sweep.comm);
}

/// The fewest whose least and most are a 95 % interval of the median.
int num_repeats(const Sweep& sweep) {
    return sweep.arguments.quick ? 2 : 6;
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
        succeeded =
            measure_missing(sweep, workload, snapshot_settings(sweep.arguments.quick), rows) &&
            succeeded;
    }
    return succeeded;
}

bool study_simulations(const Sweep& sweep) {
    Study study(sweep, study_plan(sweep), "sweep_simulation.csv", "history");
    const bool succeeded = study.run(repeated_settings(sweep.arguments.quick), num_repeats(sweep));
    return study.run(study_settings(sweep.arguments.quick), 1) && succeeded;
}

bool study_ranks(const Sweep& sweep) {
    constexpr int ranks_of_figure_2 = 6;
    if (sweep.num_ranks == ranks_of_figure_2) write_six_boxes(sweep);
    return Study(sweep, study_plan(sweep), "sweep_simulation.csv", "history")
        .run(standard_settings(), num_repeats(sweep));
}

bool study_paper(const Sweep& sweep) {
    std::vector<Method> settings = read_methods("zoltan-rcb,root-rcb,rrcb");
    for (Method& method : winning_settings()) settings.push_back(std::move(method));
    return Study(sweep, paper_plan(sweep), "paper_simulation.csv", "paper_history")
        .run(settings, 1);
}

}  // namespace comparisons
