#include "cycle_mpi.hpp"

#include "comparison_mpi.hpp"
#include "failure_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "rrcb_balancer_mpi.hpp"
#include "scene_choice_mpi.hpp"
#include "scene_mpi.hpp"
#include "sweep_settings.hpp"
#include "workload_mpi.hpp"

#include <rrcb/quality.hpp>

#include <mpm/simulation.hpp>

#include <array>
#include <stdexcept>

namespace comparisons {

namespace {

/// Coordinates of a workload axis by axis, as the simulation has them.
std::array<std::vector<double>, 3> by_axis(const Workload& workload) {
    const auto dimension = static_cast<std::size_t>(workload.dimension);
    std::array<std::vector<double>, 3> columns;
    for (std::size_t i = 0; i < workload.coordinates.size(); ++i) {
        columns[i % dimension].push_back(workload.coordinates[i]);
    }
    return columns;
}

/// Every setting with every seed that it has; none: no seed.
struct SeededMethod {
    Method method;
    std::string seed;
};

std::vector<SeededMethod> seeded_settings(bool quick) {
    const std::uint64_t num_seeds = quick ? 2 : 10;
    std::vector<SeededMethod> settings;
    for (const Method& method : cycle_settings(quick)) {
        if (!varies_with_seed(method)) {
            settings.push_back({method, ""});
            continue;
        }
        for (std::uint64_t seed = 1; seed <= num_seeds; ++seed) {
            settings.push_back({with_next_seed(method, seed - 1), std::to_string(seed)});
        }
    }
    return settings;
}

Row cycle_key(const Sweep& sweep, rrcb::GlobalCount num_points, const SeededMethod& setting,
              int call) {
    return Row()
        .add("method", setting.method.label)
        .add("ranks", sweep.num_ranks)
        .add("points", num_points)
        .add("seed", setting.seed)
        .add("call", call)
        .end_key();
}

Row cycle_row(Row key, const StillCall& result, const std::string& error) {
    return key.add("imbalance", result.imbalance)
        .add("moved_fraction", result.moved_fraction)
        .add_error(error);
}

/// Of our own methods the C++ interface: the plug-in remembers where it sent the points, and leaves
/// alone what is still there.
mpm::Balancer memoryless(const Method& method) {
    if (!method.options) return *make_balancer(method);
    return std::visit([](const auto& options) { return rrcb_balancer(options); }, *method.options);
}

/// The rows of one setting; one that tells why where it failed.
std::vector<Row> cycle_rows(const Sweep& sweep, const Workload& start, rrcb::GlobalCount num_points,
                            const SeededMethod& setting, int num_calls) {
    std::vector<Row> rows;
    try {
        int number = 0;
        for (const StillCall& call :
             balance_still_points(start, memoryless(setting.method), num_calls, sweep.comm)) {
            rows.push_back(cycle_row(cycle_key(sweep, num_points, setting, ++number), call, ""));
        }
    } catch (const std::runtime_error& error) {
        rows = {cycle_row(cycle_key(sweep, num_points, setting, 1), {}, error.what())};
    }
    return rows;
}

}  // namespace

Workload start_of_slope(const Sweep& sweep) {
    const mpm::Simulation simulation(choose_scene("slope", sweep.arguments.quick, sweep.comm),
                                     sweep.comm);
    return snapshot("slope-start", simulation);
}

std::vector<StillCall> balance_still_points(Workload workload, const mpm::Balancer& balancer,
                                            int num_calls, MPI_Comm comm) {
    const int num_parts = size_of(comm);
    std::vector<StillCall> calls;
    for (int call = 0; call < num_calls; ++call) {
        const std::array<std::vector<double>, 3> columns = by_axis(workload);
        const std::vector<int> owners =
            balancer({columns[0], columns[1], columns[2]}, comm).local_owners;
        const rrcb::Points points = workload.points();
        calls.push_back({rrcb::imbalance(rrcb::part_weights(points, owners, num_parts, comm)),
                         rrcb::moved_fraction(points, owners, num_parts, comm)});
        move(workload, owners, comm);
    }
    return calls;
}

bool study_cycle(const Sweep& sweep) {
    const int num_calls = sweep.arguments.quick ? 4 : 20;
    SavedRows rows(sweep.folder, "cycle.csv", cycle_row(cycle_key(sweep, 0, {}, 0), {}, ""));
    const Workload start = start_of_slope(sweep);
    const rrcb::GlobalCount num_points = describe(start, {}, sweep.comm).num_points;
    std::vector<SeededMethod> settings = seeded_settings(sweep.arguments.quick);
    std::erase_if(settings, [&](const SeededMethod& setting) {
        return rows.has(cycle_key(sweep, num_points, setting, num_calls));
    });
    sweep.say("calls on points that stand still: " + std::to_string(settings.size()) +
              " settings and seeds to try, " + std::to_string(num_calls) + " calls each");
    sweep.progress.start("points that stand still", static_cast<int>(settings.size()));
    bool succeeded = true;
    for (const SeededMethod& setting : settings) {
        succeeded = rows.add(cycle_rows(sweep, start, num_points, setting, num_calls)) && succeeded;
        sweep.progress.advance();
    }
    return succeeded;
}

}  // namespace comparisons
