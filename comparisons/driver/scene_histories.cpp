#include "scene_histories.hpp"

#include "load_table.hpp"
#include "scene_choice_mpi.hpp"
#include "simulation_mpi.hpp"
#include "text.hpp"

#include <rrcb/balance.hpp>

#include <mpm/simulation.hpp>

#include <algorithm>
#include <memory>

namespace comparisons {

namespace {

/// The points of all ranks' simulation on this one, at one time.
struct Snapshot {
    std::vector<double> coordinates;
    int dimension = 2;
};

Snapshot take(const mpm::Simulation& simulation) {
    const mpm::Positions at = simulation.positions();
    Snapshot snapshot;
    snapshot.dimension = at.z.empty() ? 2 : 3;
    for (std::size_t i = 0; i < at.size(); ++i) {
        snapshot.coordinates.insert(snapshot.coordinates.end(), {at.x[i], at.y[i]});
        if (snapshot.dimension == 3) snapshot.coordinates.push_back(at.z[i]);
    }
    return snapshot;
}

void count(LoadTable& table, const std::vector<Snapshot>& snapshots, int made, int num_parts) {
    rrcb::Options options;
    options.num_parts = num_parts;
    const Snapshot& source = snapshots[static_cast<std::size_t>(made)];
    const rrcb::Balance balance = rrcb::balance(
        rrcb::interleaved_points(source.coordinates, source.dimension), options, MPI_COMM_SELF);
    for (int at = made; at < static_cast<int>(snapshots.size()); ++at) {
        const Snapshot& later = snapshots[static_cast<std::size_t>(at)];
        const rrcb::Points points = rrcb::interleaved_points(later.coordinates, later.dimension);
        std::vector<rrcb::Part> parts(points.count);
        rrcb::assign(balance.cuts, points, parts);
        const double mean = static_cast<double>(points.count) / num_parts;
        for (const rrcb::Part part : parts) table.load(made, at, part) += 1 / mean;
    }
}

}  // namespace

std::vector<LoadHistory> scene_histories(const Recording& recording,
                                         const std::vector<double>& costs) {
    const mpm::Scene scene = choose_scene(recording.scene, recording.quick, MPI_COMM_SELF);
    const int num_steps = steps_to_end(scene, MPI_COMM_SELF);
    mpm::Simulation simulation(scene, MPI_COMM_SELF);
    std::vector<Snapshot> snapshots;
    const int intervals = recording.num_times - 1;
    for (int step = 0; step <= num_steps; ++step) {
        while (static_cast<int>(snapshots.size()) * num_steps <= step * intervals)
            snapshots.push_back(take(simulation));
        if (step < num_steps) simulation.step();
    }
    const auto table = std::make_shared<LoadTable>(recording.num_times, recording.num_parts);
    for (int made = 0; made < recording.num_times; ++made)
        count(*table, snapshots, made, recording.num_parts);

    const int num_replayed = std::min(num_steps, recording.most_steps);
    const double scale = static_cast<double>(intervals) / num_replayed;
    std::vector<LoadHistory> histories;
    for (const double cost : costs) {
        histories.push_back(
            {recording.scene + ", cost " + write_number(cost), num_replayed,
             [table, scale](int made, int step) { return table->step(made * scale, step * scale); },
             [cost](int) { return cost; }});
    }
    return histories;
}

}  // namespace comparisons
