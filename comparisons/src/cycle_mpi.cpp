#include "cycle_mpi.hpp"

#include "balancer_mpi.hpp"
#include "layout_mpi.hpp"
#include "rrcb_balancer_mpi.hpp"
#include "scene_choice_mpi.hpp"
#include "sweep_settings.hpp"
#include "text.hpp"

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

std::string cycle_key(const Sweep& sweep, rrcb::GlobalCount num_points, const SeededMethod& setting,
                      int call) {
    return csv_field(setting.method.label) + ',' + std::to_string(sweep.num_ranks) + ',' +
           std::to_string(num_points) + ',' + setting.seed + ',' + std::to_string(call);
}

/// Of our own methods the C++ interface: the plug-in remembers where it sent the points, and leaves
/// alone what is still there.
mpm::Balancer memoryless(const Method& method) {
    return method.options ? rrcb_balancer(*method.options) : *make_balancer(method);
}

/// The rows of one setting; one that tells why where it failed.
std::string cycle_rows(const Sweep& sweep, const Workload& start, rrcb::GlobalCount num_points,
                       const SeededMethod& setting, int num_calls) {
    std::string rows;
    try {
        const std::vector<StillCall> calls =
            balance_still_points(start, memoryless(setting.method), num_calls, sweep.comm);
        for (int call = 1; call <= num_calls; ++call) {
            const StillCall& result = calls[static_cast<std::size_t>(call) - 1];
            rows += cycle_key(sweep, num_points, setting, call) + ',' +
                    write_number(result.imbalance) + ',' + write_number(result.moved_fraction) +
                    ",\n";
        }
    } catch (const std::runtime_error& error) {
        rows = cycle_key(sweep, num_points, setting, 1) + ",,," + csv_field(error.what()) + '\n';
    }
    return rows;
}

}  // namespace

Workload start_of_slope(const Sweep& sweep) {
    const mpm::Simulation simulation(choose_scene("slope", sweep.arguments.quick, sweep.comm),
                                     sweep.comm);
    Workload workload;
    workload.name = "slope-start";
    workload.layout = "simulation";
    workload.coordinates = interleaved(simulation.positions());
    return workload;
}

std::vector<StillCall> balance_still_points(Workload workload, const mpm::Balancer& balancer,
                                            int num_calls, MPI_Comm comm) {
    int num_parts = 1;
    MPI_Comm_size(comm, &num_parts);
    std::vector<StillCall> calls;
    for (int call = 0; call < num_calls; ++call) {
        const std::array<std::vector<double>, 3> columns = by_axis(workload);
        const std::vector<int> owners =
            balancer({columns[0], columns[1], columns[2]}, comm).local_owners;
        const rrcb::Points points = workload.points();
        calls.push_back({rrcb::imbalance(rrcb::part_weights(points, owners, num_parts, comm)),
                         rrcb::moved_fraction(points, owners, num_parts, comm)});
        workload.coordinates = exchange(workload.coordinates, workload.dimension, owners, comm);
    }
    return calls;
}

bool study_cycle(const Sweep& sweep) {
    const int num_calls = sweep.arguments.quick ? 4 : 20;
    SavedRows rows(sweep.folder, "cycle.csv",
                   "method,ranks,points,seed,call,imbalance,moved_fraction,error", 5);
    const Workload start = start_of_slope(sweep);
    auto num_points = static_cast<rrcb::GlobalCount>(start.points().count);
    MPI_Allreduce(MPI_IN_PLACE, &num_points, 1, MPI_INT64_T, MPI_SUM, sweep.comm);
    std::vector<SeededMethod> settings = seeded_settings(sweep.arguments.quick);
    std::erase_if(settings, [&](const SeededMethod& setting) {
        return rows.has(cycle_key(sweep, num_points, setting, num_calls));
    });
    sweep.say("calls on points that stand still: " + std::to_string(settings.size()) +
              " settings and seeds to try, " + std::to_string(num_calls) + " calls each");
    sweep.progress.start("points that stand still", static_cast<int>(settings.size()));
    bool succeeded = true;
    for (const SeededMethod& setting : settings) {
        const std::string text = cycle_rows(sweep, start, num_points, setting, num_calls);
        succeeded = !rows.add([&](std::ostream& out) { out << text; }) && succeeded;
        sweep.progress.advance();
    }
    return succeeded;
}

}  // namespace comparisons
