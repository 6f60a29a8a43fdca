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

/// One simulation of a study.
struct Case {
    int repeat = 1;
    std::string label;
    int num_ranks = 1;
    std::optional<Method> method = {};  ///< none: nothing is rebalanced
};

/// In every repeat the serial simulation, the one without rebalancing and the settings; a method
/// that draws points takes another seed in each.
std::vector<Case> cases_of(const std::vector<Method>& settings, int num_repeats, int num_ranks) {
    std::vector<Case> cases;
    for (int repeat = 1; repeat <= num_repeats; ++repeat) {
        cases.push_back({repeat, "serial", 1});
        cases.push_back({repeat, "none", num_ranks});
        for (const Method& method : settings) {
            cases.push_back({repeat, method.label, num_ranks,
                             with_next_seed(method, static_cast<unsigned>(repeat) - 1)});
        }
    }
    return cases;
}

SimulationRun simulate(const Sweep& sweep, const SimulationPlan& plan, const Case& simulated,
                       MPI_Comm comm) {
    const Observer observe = [&](int steps_done, const mpm::Simulation&) {
        if (steps_done > 0) sweep.progress.advance();
    };
    std::optional<mpm::Balancer> balancer;
    if (simulated.method) balancer = make_balancer(*simulated.method);
    TimedSimulation simulation(plan, std::move(balancer), observe, comm);
    simulation.advance(plan.num_steps);
    SimulationRun run = simulation.result();
    run.method = simulated.label;
    return run;
}

/// The serial one on rank 0 alone. The others sleep: ranks that wait in MPI keep a core busy.
SimulationRun simulate_serially(const Sweep& sweep, const SimulationPlan& plan,
                                const Case& simulated) {
    SimulationRun run;
    if (sweep.rank == 0) run = simulate(sweep, plan, simulated, MPI_COMM_SELF);
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(sweep.comm, &request);
    for (int done = 0; done == 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return run;
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

    /// The cases_of the settings. True when none failed.
    bool run(const std::vector<Method>& settings, int num_repeats);

  private:
    bool run(const Case& simulated);

    const Sweep& sweep_;
    SimulationPlan plan_;
    std::string histories_;
    std::int64_t num_points_;
    SavedRows rows_;
};

/// The history is that of the first repeat.
bool Study::run(const Case& simulated) {
    const auto& [repeat, label, num_ranks, method] = simulated;
    const SimulationRun run = label == "serial" ? simulate_serially(sweep_, plan_, simulated)
                                                : simulate(sweep_, plan_, simulated, sweep_.comm);
    if (repeat == 1) {
        sweep_.folder.write("data/" + histories_ + '_' + file_name_part(label) + '_' +
                                std::to_string(num_ranks) + ".csv",
                            [&] { return history_csv(std::span(&run, 1)); });
    }
    const Row row = simulation_row(plan_, num_ranks, summarize({label, {run}}));
    return rows_.add({Row().add("repeat", repeat).add(row)});
}

bool Study::run(const std::vector<Method>& settings, int num_repeats) {
    const std::vector<Case> cases = cases_of(settings, num_repeats, sweep_.num_ranks);
    const std::string number = std::to_string(cases.size());
    sweep_.say("simulations of " + std::to_string(plan_.num_steps) + " steps, rebalanced every " +
               std::to_string(plan_.every) + ", " + std::to_string(sweep_.num_ranks) +
               " ranks: up to " + number);
    const double start = MPI_Wtime();
    bool succeeded = true;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Row key = simulation_key(plan_, cases[i].num_ranks, num_points_, cases[i].label);
        if (rows_.has(Row().add("repeat", cases[i].repeat).add(key))) continue;
        sweep_.progress.start(std::to_string(i + 1) + "/" + number + " " + cases[i].label,
                              plan_.num_steps);
        succeeded = run(cases[i]) && succeeded;
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
    measurement.parts = balance(*method.options, start.points(), sweep.comm).parts;
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
